#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/folder_lock.h"

namespace io {

/// A folder that comes into being whole or not at all: its files are written into a partial
/// folder beside it, FOLDER.partial-PID, which Commit renames. Destroyed without Commit, it
/// removes the partial folder; killed, it leaves that one alone, and the next OutputFolder of
/// the same name removes it when its process is gone. One process at a time writes a folder.
class OutputFolder {
 public:
  /// @param marker  file that a folder of this kind holds; `force` replaces no other. An empty
  ///   folder is replaced in any case
  /// @throws InputError, see RequirePlace; also when the place cannot be written to
  OutputFolder(const std::filesystem::path& folder, std::string marker, bool force);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// The same refusals without making anything, for who has work to do before there is something
  /// to write.
  /// @throws InputError when the folder exists and `force` is off, when it exists and is not of
  ///   this kind, when it cannot be replaced (the current folder, a mount point), when another
  ///   process is writing it, or when it would be in a file
  static void RequirePlace(const std::filesystem::path& folder, const std::string& marker,
                           bool force);

  /// Where to write a file of the folder until Commit; makes the folders above it.
  /// @throws InputError
  std::filesystem::path Path(const std::filesystem::path& relative) const;
  /// Writes one file whole. @throws InputError naming it, e.g. when the disk is full
  void Write(const std::filesystem::path& relative, std::string_view bytes) const;

  /// Puts the folder in its place, over the old one when forced. Nothing may be written after.
  /// @throws InputError
  void Commit();

 private:
  void GiveUp() const;

  std::filesystem::path final_, partial_;
  std::vector<std::filesystem::path> made_;  ///< folders above it, the innermost first
  std::string marker_;
  bool force_;
  std::optional<FolderLock> lock_;  ///< of the partial folder
};

/// Makes a folder, and those above it, unless it is there.
/// @throws InputError when it is a file or cannot be made
void MakeFolder(const std::filesystem::path& folder);

}  // namespace io
