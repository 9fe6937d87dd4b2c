#include "eval/formats/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/formats/images.h"
#include "eval/formats/trajectory.h"
#include "io/folder_kind.h"

namespace eval {
namespace {

namespace fs = std::filesystem;

void SortPoses(Trajectory& trajectory) {
  std::stable_sort(
      trajectory.begin(), trajectory.end(),
      [](const StampedPose& a, const StampedPose& b) { return a.stamp_s < b.stamp_s; });
}

void TellTwoPosesOfAFrame(Folder& folder, const std::string& file,
                          const Trajectory& trajectory) {
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const double stamp_s = trajectory[i].stamp_s;
    if (stamp_s > trajectory[i - 1].stamp_s + kSameStamp_s) continue;
    folder.Tell(file, trajectory[i].line,
                fmt::format("two poses for the frame at {:.6f} s", stamp_s),
                "write one line per tracked frame");
  }
}

}  // namespace

Run ReadRun(Folder& folder) {
  const auto expects = [&](const char* file) {
    return folder.Require(file, kRunAgain, Severity::kFlaw);
  };
  const std::string poses = "trajectory.txt", keyframes = "keyframes.txt";
  Run run;
  run.folder = folder.root();
  run.info = ReadRunInfo(folder);
  if (folder.Require(poses, kRunAgain)) {
    run.trajectory = ReadTrajectory(folder, poses);
    SortPoses(run.trajectory);
    TellTwoPosesOfAFrame(folder, poses, run.trajectory);
  }
  if (expects(keyframes.c_str())) run.keyframes = ReadTrajectory(folder, keyframes);
  if (expects("map.json")) {
    auto map = ReadRunMap(folder);
    run.has_map = map.has_value();
    if (map) run.map = std::move(*map);
  }
  run.has_planes = expects("frame_planes.jsonl");
  if (run.has_planes) run.frames = ReadRunFrames(folder);
  if (expects("timing.csv")) run.timing = ReadTiming(folder);
  run.segmentation_files = StampedFiles(folder.root() / "segmentation");
  return run;
}

Run ReadRun(const fs::path& path) {
  io::RequireRun(path);
  Folder folder(path);
  return ReadRun(folder);
}

fs::path SequenceOf(const Run& run) {
  const fs::path written = run.info.sequence;
  const fs::path beside = run.folder / written;
  for (const fs::path& candidate : {written, beside}) {
    std::error_code ignored;
    if (!written.empty() && fs::is_directory(candidate, ignored)) return candidate;
  }
  throw io::InputError((run.folder / "run.json").string(),
                       "sequence: found no folder \"" + written.string() + "\" nor \"" +
                           beside.string() + "\"; name it with --truth");
}

std::optional<cv::Mat1w> ReadSegmentation(const Run& run, double stamp_s) {
  const auto file = run.segmentation_files.Find(stamp_s);
  if (!file) return std::nullopt;
  return ReadLabels(*file);
}

}  // namespace eval
