#include "eval/formats/stamped_files.h"

#include <algorithm>

#include "io/number_text.h"

namespace eval {

StampedFiles::StampedFiles(const std::filesystem::path& folder, const char* extension) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != extension) continue;
    const auto stamp_s = io::ParseNumber(entry.path().stem().string());
    if (stamp_s) files_.emplace_back(*stamp_s, entry.path());
  }
  std::sort(files_.begin(), files_.end());
}

std::optional<std::filesystem::path> StampedFiles::Find(double stamp_s) const {
  const auto from = std::lower_bound(files_.begin(), files_.end(), stamp_s - kSameStamp_s,
                                     [](const auto& f, double s) { return f.first < s; });
  if (from == files_.end() || !(from->first <= stamp_s + kSameStamp_s)) return std::nullopt;
  return from->second;
}

}  // namespace eval
