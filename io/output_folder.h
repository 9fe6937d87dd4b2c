#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace io {

/// A folder that comes into being whole or not at all: its files are written into a partial
/// folder beside it, FOLDER.partial-PID, which Commit renames. Destroyed without Commit, it
/// removes the partial folder; killed, it leaves that one alone, and the next OutputFolder of
/// the same name removes it when its process is gone.
class OutputFolder {
 public:
  /// @param marker  file that a folder of this kind holds; `force` replaces no other. An empty
  ///   folder is replaced in any case
  /// @throws InputError when the folder exists and `force` is off, when it exists and is not of
  ///   this kind, when it is the current folder, or when the place cannot be written to
  OutputFolder(const std::filesystem::path& folder, std::string marker, bool force);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write a file of the folder until Commit; makes the folders above it.
  /// @throws InputError
  std::filesystem::path Path(const std::filesystem::path& relative) const;
  /// Writes one file whole. @throws InputError naming it, e.g. when the disk is full
  void Write(const std::filesystem::path& relative, std::string_view bytes) const;

  /// Puts the folder in its place, over the old one when forced. Nothing may be written after.
  /// @throws InputError
  void Commit();

 private:
  void RefuseWhatIsThere() const;
  void GiveUp() const;

  std::filesystem::path final_, partial_;
  std::vector<std::filesystem::path> made_;  ///< folders above it, the innermost first
  std::string marker_;
  bool force_;
};

/// Makes a folder, and those above it, unless it is there.
/// @throws InputError when it is a file or cannot be made
void MakeFolder(const std::filesystem::path& folder);

}  // namespace io
