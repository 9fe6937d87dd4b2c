#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace io {

/// Suffix of a file that is being written; one left behind was never finished.
inline constexpr const char* kUnfinishedSuffix = ".part";

/// A file that is there whole after Finish and not at all before, made piece by piece under a
/// temporary name beside its place, by one process at a time. It replaces no link and no device.
/// All calls throw InputError naming the file and the reason (no space, no permission ...).
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();  ///< unfinished, it is gone
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void Add(std::string_view bytes);
  /// Puts the file in its place, over an older one; nothing may be added after.
  void Finish();

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::string pending_;
};

/// The same for a file that is held as a whole.
void WriteFile(const std::filesystem::path& path, std::string_view bytes);

/// Writes to an open descriptor. @throws InputError naming `path`
void WriteAll(int file, std::string_view bytes, const std::filesystem::path& path);

/// @throws InputError: the file or folder cannot be written, why, and what can be done
[[noreturn]] void FailToWrite(const std::filesystem::path& path, const std::error_code& error);

}  // namespace io
