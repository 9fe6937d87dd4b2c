#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sim {

/// Suffix of a file that is being written; one left behind was never finished.
inline constexpr const char* kUnfinishedSuffix = ".part";

/// Writes a file whole or not at all: under a temporary name beside it, then renamed.
/// @throws InputError naming the file and the reason (no space, no permission ...).
void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes);

/// The whole content of a file. @throws InputError when it cannot be read.
std::string ReadWholeFile(const std::filesystem::path& path);

}  // namespace sim
