#pragma once

#include <optional>
#include <string>

#include "eval/formats/folder.h"

namespace eval {

/// run.json: what was run on what.
struct RunInfo {
  std::string sequence;  ///< as written: absolute, or relative to the caller or to the run
  std::string camera;    ///< a name or a file; empty when the run does not tell
  std::string variant, detector, version;
  std::optional<int> frames, tracked;
  bool interrupted = false;            ///< stopped before the end of the sequence
  std::optional<int> sequence_frames;  ///< all there were to process
  std::optional<double> wall_time_s, peak_memory_mb;
};

/// How a fault of a run is mended, as a rule.
inline constexpr const char* kRunAgain = "run the SLAM system again";

/// Reads run.json, which every run has.
RunInfo ReadRunInfo(Folder& folder);

}  // namespace eval
