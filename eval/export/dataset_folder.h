#pragma once

#include <filesystem>
#include <string>

namespace eval {

/// A dataset that is there whole after Finish and not at all before: it grows under a hidden
/// name beside its place.
class DatasetFolder {
 public:
  /// @param kind   goes into export.json, which marks the folder as an export
  /// @param force  replace an older export; nothing else is ever replaced
  /// @throws InputError when the folder exists, or cannot be made
  DatasetFolder(const std::filesystem::path& folder, std::string kind, bool force);
  ~DatasetFolder();
  DatasetFolder(const DatasetFolder&) = delete;
  DatasetFolder& operator=(const DatasetFolder&) = delete;

  /// Makes the folders above a file of the dataset. @returns where to write it now
  std::filesystem::path File(const std::filesystem::path& relative) const;
  /// @throws InputError when it cannot be written
  void Write(const std::filesystem::path& relative, const std::string& text) const;
  void Copy(const std::filesystem::path& from, const std::filesystem::path& relative) const;
  /// Writes export.json and puts the folder in its place.
  void Finish();

 private:
  std::filesystem::path final_, partial_;
  std::string kind_;
};

}  // namespace eval
