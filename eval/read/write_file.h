#pragma once

#include <filesystem>
#include <string>

namespace eval {

/// Writes the whole text or nothing: under a temporary name in the same folder, then renamed.
/// @throws InputError if the folder cannot be written.
void WriteFile(const std::filesystem::path& file, const std::string& text);

}  // namespace eval
