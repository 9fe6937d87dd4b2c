#pragma once

#include <filesystem>
#include <string>

namespace slam {

/// A folder that comes into being whole or not at all: its files are written into a partial
/// folder beside it, FOLDER.partial-PID, which Commit renames. Destroyed without Commit, it
/// removes the partial folder; killed, it leaves that one alone, and the next OutputFolder of
/// the same name removes it when its process is gone.
class OutputFolder {
 public:
  /// @param marker  file that a folder of this kind holds; `force` replaces no other folder
  /// @throws InputError when the folder exists and `force` is off, when it exists and is not of
  ///         this kind, or when the place cannot be written to.
  OutputFolder(const std::filesystem::path& folder, std::string marker, bool force);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& final_path() const { return final_; }
  /// Where to write until Commit.
  const std::filesystem::path& partial_path() const { return partial_; }

  /// Writes one file whole, under a temporary name first.
  /// @throws std::runtime_error naming the file, e.g. when the disk is full.
  void WriteFile(const std::string& name, const std::string& bytes) const;

  /// Puts the folder in its place, over the old one when forced.
  /// @throws std::runtime_error
  void Commit();

 private:
  void RefuseWhatIsThere() const;

  std::filesystem::path final_, partial_;
  std::string marker_;
  bool force_;
  bool committed_ = false;
};

}  // namespace slam
