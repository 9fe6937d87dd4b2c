#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace eval {

/// Two stamps closer than this are one frame: above the round-off of a six-digit stamp in a
/// double (2.4e-7 s at 1.3e9 s), far below any camera's frame time.
inline constexpr double kSameStamp_s = 1e-5;

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

/// Index of the entry of rising `stamps_s` that is the frame at `stamp_s`, if any.
std::optional<std::size_t> FindStamp(const std::vector<double>& stamps_s, double stamp_s);

}  // namespace eval
