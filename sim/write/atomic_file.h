#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/scene/sha256.h"

namespace sim {

/// Suffix of a file that is being written; one left behind was never finished.
inline constexpr const char* kUnfinishedSuffix = ".part";

/// Writes a file whole or not at all: under a temporary name beside it, then renamed.
/// @throws InputError naming the file and the reason (no space, no permission ...).
void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes);

/// The same for a file that is made piece by piece and never held as a whole.
class AtomicFile {
 public:
  /// @throws InputError, as every other call, naming the file and the reason
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();  ///< unfinished, it is gone
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void Add(std::string_view bytes);
  /// Puts the file in its place; nothing may be added after. @returns its SHA-256
  std::string Finish();

 private:
  void Flush();

  std::filesystem::path path_;
  int file_;
  std::string pending_;
  Sha256 sum_;
};

/// The whole content of a file. @throws InputError when it cannot be read.
std::string ReadWholeFile(const std::filesystem::path& path);

}  // namespace sim
