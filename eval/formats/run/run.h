#pragma once

#include <opencv2/core.hpp>

#include "eval/formats/pose/pose.h"
#include "eval/formats/run/frame_planes.h"
#include "eval/formats/run/pose_covariance.h"
#include "eval/formats/run/run_info.h"
#include "eval/formats/run/run_map.h"
#include "eval/formats/run/timing.h"
#include "eval/formats/stamped_files.h"

namespace eval {

/// A run folder: what a SLAM system said about a sequence. Images are read on demand.
struct Run {
  std::filesystem::path folder;
  RunInfo info;
  Trajectory trajectory;  ///< T_wc, tracked frames, by rising stamp
  /// Of the poses, by rising stamp; nothing without trajectory_covariance.txt.
  std::optional<std::vector<PoseCovariance>> covariances;
  std::optional<Trajectory> keyframes;
  std::vector<RunFrame> frames;  ///< empty without frame_planes.jsonl
  std::vector<RunMapPlane> map;  ///< empty without map.json
  bool has_planes = false;       ///< there is a frame_planes.jsonl
  bool has_map = false;          ///< there is a map.json with a list of planes
  std::optional<Timing> timing;
  /// Index of the frame plane + 1, 0 = none; without frame_planes.jsonl any labels.
  StampedFiles segmentation_files;
  std::vector<Fault> warnings;  ///< faults that figures and pictures can live with
};

/// Reads the folder. trajectory.txt is required; that one of the rest is missing is a flaw, so that
/// other systems can be scored by what they give.
Run ReadRun(Folder& folder);
/// @throws InputError naming the file and line, or the required file that is missing.
Run ReadRun(const std::filesystem::path& folder);

/// A folder of label images alone, named after the times of their frames: a run that says nothing
/// else. @throws InputError when it is no folder or has no such image
Run RunOfLabels(const std::filesystem::path& folder);

/// The sequence that run.json names: relative to the run folder, to the folder above, to the
/// caller, else where it was when the run was made.
/// @throws InputError naming all these places if none is a folder, or when there is no run.json
std::filesystem::path SequenceOf(const Run& run);

/// The segmentation of the frame, if the run saved it.
std::optional<cv::Mat1w> ReadSegmentation(const Run& run, double stamp_s);

}  // namespace eval
