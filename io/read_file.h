#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace io {

/// Most bytes of a file that is read as a whole, if its reader does not say: the largest that are
/// read, models of networks, have half of it.
inline constexpr std::uintmax_t kMaxFile_bytes = std::uintmax_t{1} << 29;

/// A regular file, open at its beginning. Pipes, sockets and devices are refused unopened.
/// @param mend  ends the message of an error: what the file should be, or what to do without it
/// @throws InputError when it is not there, is no file, or cannot be opened (with the reason)
std::ifstream OpenFile(const std::filesystem::path& file, const std::string& mend = "");

/// All its bytes.
/// @throws InputError also when it is larger than `max_bytes`
std::string ReadFile(const std::filesystem::path& file, const std::string& mend = "",
                     std::uintmax_t max_bytes = kMaxFile_bytes);

}  // namespace io
