#pragma once

#include <filesystem>

namespace io {

/// The right of one process to write into a folder. It ends with the object, and with the
/// process however that ends; nothing is left in the folder. (Of a file system without locks
/// nothing can be had, and nothing is asked.)
class FolderLock {
 public:
  /// Makes the folder if it is not there. @throws InputError when another process writes it,
  /// when it is a file, or cannot be made
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Whether some process has the right; false of what is no folder.
  static bool IsHeld(const std::filesystem::path& folder);

 private:
  int folder_;
};

}  // namespace io
