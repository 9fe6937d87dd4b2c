#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace io {

/// SHA-256 of the bytes, 64 lower-case hexadecimal digits.
std::string Sha256Hex(std::string_view bytes);

/// The same of a file's content, which is never held as a whole.
/// @throws InputError when the file cannot be read.
std::string Sha256OfFile(const std::filesystem::path& path);

}  // namespace io
