#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "eval/formats/stamps.h"

namespace eval {

/// The images of a folder that are named after their frame's time, by rising stamp.
class StampedFiles {
 public:
  StampedFiles() = default;
  /// Files whose name ends in `extension`; names that are no number are left out. A folder
  /// that is missing has no files.
  explicit StampedFiles(const std::filesystem::path& folder, const char* extension = ".png");

  /// The file of the frame, if there is one.
  std::optional<std::filesystem::path> Find(double stamp_s) const;
  bool empty() const { return files_.empty(); }
  std::size_t size() const { return files_.size(); }

 private:
  std::vector<std::pair<double, std::filesystem::path>> files_;
};

}  // namespace eval
