#include "eval/check/check_run.h"

#include <fmt/format.h>

#include <optional>

#include "eval/check/check_frame_planes.h"
#include "eval/check/check_map.h"
#include "eval/check/check_ply.h"
#include "eval/check/check_segmentation.h"
#include "eval/check/check_timing.h"
#include "eval/check/check_trajectory.h"
#include "eval/check/checked_json.h"
#include "eval/check/checked_text.h"

namespace eval {
namespace {

const std::string kFile = "run.json";
constexpr const char* kRunAgain = "run the SLAM system again";

struct RunCounts {
  std::optional<long> frames, tracked;
};

// A figure whose name carries its unit: "wall_time_s", "peak_memory_mib".
void CheckFigure(const CheckedJson& root, const std::string& begins,
                 const std::string& meaning) {
  for (const auto& [key, value] : root.value().items()) {
    if (key.rfind(begins, 0) != 0) continue;
    const auto number = root.Number(key);
    if (number && !(*number >= 0)) root.ReportAt(key, "is negative", kRunAgain);
    return;
  }
  root.ReportAt(begins, "is missing; expected " + meaning, kRunAgain);
}

void CheckCounts(const CheckedJson& root, RunCounts& counts) {
  counts.frames = root.Integer("frames");
  counts.tracked = root.Integer("tracked");
  const auto lost = root.Integer("lost");
  if (counts.frames && *counts.frames < 0) root.ReportAt("frames", "is negative", kRunAgain);
  if (lost && *lost < 0) root.ReportAt("lost", "is negative", kRunAgain);
  if (!counts.frames || !counts.tracked) return;
  if (*counts.tracked >= 0 && *counts.tracked <= *counts.frames) return;
  root.ReportAt("tracked", fmt::format("is {} of {} frames", *counts.tracked, *counts.frames),
                kRunAgain);
}

RunCounts CheckRunJson(FolderCheck& check) {
  RunCounts counts;
  if (!check.Require(kFile, "every run has it; " + std::string(kRunAgain))) return counts;
  VisitJson(check, kFile, [&](const CheckedJson& root) {
    const auto format = root.Text("format");
    if (format && *format != "pas-run/1") {
      root.ReportAt("format", "is " + *format + "; expected pas-run/1",
                    "convert the run to this version of the format");
    }
    for (const char* key : {"sequence", "variant", "association", "detector", "version"}) {
      root.Text(key);
    }
    root.Integer("seed");
    if (!root.Has("options")) {
      root.ReportAt("options", "is missing; expected the options of the run", kRunAgain);
    }
    CheckCounts(root, counts);
    CheckFigure(root, "wall", "the wall time");
    CheckFigure(root, "peak", "the peak memory");
  });
  return counts;
}

void CheckTrackedCount(FolderCheck& check, const RunCounts& counts,
                       const std::vector<CheckedPose>& poses) {
  const long lines = static_cast<long>(poses.size());
  if (!counts.tracked || *counts.tracked == lines) return;
  check.Add("trajectory.txt", 0,
            fmt::format("has {} poses, but run.json tells of {} tracked frames", lines,
                        *counts.tracked),
            "write one line for each tracked frame");
}

// Poses exist only at times of frames, keyframes only at times of poses.
void CheckTimes(FolderCheck& check, const std::string& file,
                const std::vector<CheckedPose>& poses, const std::vector<double>& stamps_s,
                const std::string& of) {
  for (const CheckedPose& pose : poses) {
    if (NearestStamp(stamps_s, pose.stamp_s, kSameInstant_s)) continue;
    check.Add(file, pose.line, fmt::format("{:.6f} is no time of {}", pose.stamp_s, of),
              "write the time of the frame as the sequence gives it");
  }
}

std::vector<double> Stamps(const std::vector<CheckedPose>& poses) {
  std::vector<double> stamps;
  for (const CheckedPose& pose : poses) stamps.push_back(pose.stamp_s);
  return stamps;
}

}  // namespace

CheckReport CheckRun(const std::filesystem::path& folder) {
  FolderCheck check{folder, {}, {}, {}};
  const RunCounts counts = CheckRunJson(check);

  std::vector<CheckedPose> poses, keyframes;
  if (check.Require("trajectory.txt", kRunAgain)) {
    poses = CheckTrajectory(check, "trajectory.txt");
    CheckTrackedCount(check, counts, poses);
  }
  if (check.Require("keyframes.txt", kRunAgain)) {
    keyframes = CheckTrajectory(check, "keyframes.txt");
    CheckTimes(check, "keyframes.txt", keyframes, Stamps(poses), "trajectory.txt");
  }

  const CheckedMap map = CheckMap(check);
  const FramePlaneCounts planes = CheckFramePlanes(check, map);
  if (check.Has("frame_planes.jsonl")) {
    CheckTimes(check, "trajectory.txt", poses, planes.stamps_s, "frame_planes.jsonl");
    const long lines = static_cast<long>(planes.stamps_s.size());
    if (counts.frames && *counts.frames != lines) {
      check.Add("frame_planes.jsonl", 0,
                fmt::format("has {} frames, but run.json tells of {}", lines, *counts.frames),
                "write one line for each frame");
    }
  }
  CheckSegmentation(check, planes);
  CheckPly(check, map);
  CheckTiming(check);
  return {"run", std::move(check.faults), static_cast<int>(check.files.size()),
          static_cast<int>(counts.frames.value_or(static_cast<long>(planes.stamps_s.size())))};
}

}  // namespace eval
