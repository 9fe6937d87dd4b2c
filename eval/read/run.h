#pragma once

#include <opencv2/core.hpp>

#include "eval/read/run_planes.h"
#include "eval/read/stamped_files.h"

namespace eval {

/// run.json: what was run on what.
struct RunInfo {
  std::string sequence;  ///< as written: absolute, or relative to the caller or to the run
  std::string variant, detector, version;
  std::optional<int> frames, tracked;
  std::optional<double> wall_time_s, peak_memory_mb;
};

/// timing.csv: milliseconds per module and frame; NaN where a module did not run.
struct Timing {
  std::vector<std::string> modules;  ///< column names after `timestamp`
  std::vector<double> stamps_s;
  std::vector<std::vector<double>> rows_ms;  ///< one per stamp, one entry per module
};

/// A run folder: what a SLAM system said about a sequence. Images are read on demand.
struct Run {
  std::filesystem::path folder;
  RunInfo info;
  Trajectory trajectory;  ///< T_wc, tracked frames, by rising stamp
  std::optional<Trajectory> keyframes;
  std::vector<RunFrame> frames;  ///< empty without frame_planes.jsonl
  std::vector<RunMapPlane> map;  ///< empty without map.json
  bool has_planes = false;       ///< there is a frame_planes.jsonl
  bool has_map = false;          ///< there is a map.json
  std::optional<Timing> timing;
  StampedFiles segmentation_files;  ///< index of the frame plane + 1, 0 = none
};

/// Reads the folder. run.json and trajectory.txt are required, the rest may be missing so that
/// other systems can be scored by what they give.
/// @throws InputError naming the file and line, or the required file that is missing.
Run ReadRun(const std::filesystem::path& folder);

/// The sequence that run.json names: the path as it stands, else relative to the run folder.
/// @throws InputError naming both places if neither is a folder.
std::filesystem::path SequenceOf(const Run& run);

/// The segmentation of the frame, if the run saved it.
std::optional<cv::Mat1w> ReadSegmentation(const Run& run, double stamp_s);

/// @throws InputError with file:line.
Timing ReadTiming(const std::filesystem::path& file);

}  // namespace eval
