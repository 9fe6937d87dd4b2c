#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace io {

/// A regular file, open at its beginning.
/// @param mend  ends the message of an error: what the file should be, or what to do without it
/// @throws InputError when it is not there, is no file, or cannot be opened (with the reason)
std::ifstream OpenFile(const std::filesystem::path& file, const std::string& mend = "");

/// All its bytes.
/// @throws InputError also when it is larger than `max_bytes`
std::string ReadFile(const std::filesystem::path& file, const std::string& mend = "",
                     std::uintmax_t max_bytes = std::uintmax_t{1} << 40);

}  // namespace io
