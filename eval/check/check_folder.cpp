#include "eval/check/check_folder.h"

#include <algorithm>
#include <vector>

#include "eval/check/check_run.h"
#include "eval/check/check_sequence.h"

namespace eval {

CheckReport CheckFolder(const std::filesystem::path& folder, bool deep) {
  const Folder place(folder);
  const auto has_any = [&](const std::vector<std::string>& files) {
    return std::any_of(files.begin(), files.end(),
                       [&](const std::string& file) { return place.Has(file); });
  };
  if (!std::filesystem::is_directory(folder)) {
    return {"folder", {{".", 0, "", "is not a folder", "name a sequence or a run"}}, 0, 0};
  }
  if (place.Has("run.json")) return CheckRun(folder);
  if (has_any({"manifest.json", "rgb.txt", "depth.txt", "rgb", "depth"})) {
    return CheckSequence(folder, deep);
  }
  if (has_any({"trajectory.txt", "frame_planes.jsonl", "map.json"})) return CheckRun(folder);
  return {"folder",
          {{".", 0, "", "is neither a sequence (no rgb.txt) nor a run (no run.json)",
            "name a folder made by `pas sim`, `pas slam` or by a recorder in TUM's format"}},
          0,
          0};
}

}  // namespace eval
