#include "eval/check/check_run.h"

#include <fmt/format.h>

#include "eval/check/check_decisions.h"
#include "eval/check/check_ply.h"
#include "eval/check/check_segmentation.h"
#include "eval/formats/run.h"

namespace eval {
namespace {

// Poses exist only at times of frames, keyframes only at times of poses.
void CheckTimes(Folder& folder, const std::string& file, const Trajectory& poses,
                const std::vector<double>& stamps_s, const std::string& of) {
  for (const StampedPose& pose : poses) {
    if (NearestStamp(stamps_s, pose.stamp_s, kSameInstant_s)) continue;
    folder.Tell(file, pose.line, fmt::format("{:.6f} is no time of {}", pose.stamp_s, of),
                "write the time of the frame as the sequence gives it");
  }
}

void CheckCount(Folder& folder, const std::string& file, std::size_t count, const char* what,
                const std::optional<int>& told, const char* records) {
  if (!told || *told == static_cast<int>(count)) return;
  folder.Tell(file, 0, fmt::format("has {} {}, but run.json tells of {}", count, what, *told),
              fmt::format("write one line for each {}", records));
}

}  // namespace

CheckReport CheckRun(const std::filesystem::path& path) {
  Folder folder(path, OnFault::kCollect);
  const Run run = ReadRun(folder);
  const std::vector<double> frames_s = StampsOf(run.frames);
  if (folder.Has("trajectory.txt")) {
    CheckCount(folder, "trajectory.txt", run.trajectory.size(), "poses", run.info.tracked,
               "tracked frame");
  }
  if (run.keyframes) {
    CheckTimes(folder, "keyframes.txt", *run.keyframes, StampsOf(run.trajectory),
               "trajectory.txt");
  }
  if (run.has_planes) {
    CheckTimes(folder, "trajectory.txt", run.trajectory, frames_s, "frame_planes.jsonl");
    CheckCount(folder, "frame_planes.jsonl", run.frames.size(), "frames", run.info.frames,
               "frame");
    CheckDecisions(folder, run);
  }
  CheckSegmentation(folder, run);
  CheckPly(folder, run);
  return {"run", std::move(folder.faults()), static_cast<int>(folder.opened().size()),
          run.info.frames.value_or(static_cast<int>(run.frames.size()))};
}

}  // namespace eval
