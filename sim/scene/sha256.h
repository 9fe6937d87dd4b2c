#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sim {

/// SHA-256 of the bytes, 64 lower-case hexadecimal digits.
std::string Sha256Hex(std::string_view bytes);

/// The same of a file's content.
/// @throws InputError when the file cannot be read.
std::string Sha256OfFile(const std::filesystem::path& path);

}  // namespace sim
