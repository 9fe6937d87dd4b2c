#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace io {

/// A folder that comes into being whole or not at all: its files are written into a partial
/// folder beside it, FOLDER.partial-PID, which Commit renames. Destroyed without Commit, it
/// removes the partial folder; killed, it leaves that one alone, and the next OutputFolder of
/// the same name removes it when its process is gone.
class OutputFolder {
 public:
  /// @param marker  file that a folder of this kind holds; `force` replaces no other folder but
  ///   an empty one
  /// @throws InputError when the folder exists and `force` is off, when it exists and is not of
  ///   this kind, or when the place cannot be written to
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

  std::filesystem::path final_, partial_;
  std::string marker_;
  bool force_;
};

}  // namespace io
