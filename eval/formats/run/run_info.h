#pragma once

#include <optional>
#include <string>

#include "eval/formats/folder.h"
#include "eval/formats/sequence/camera.h"

namespace eval {

/// run.json: what was run on what.
struct RunInfo {
  std::string sequence;           ///< as written: relative to the run, or absolute
  std::string sequence_absolute;  ///< where it was when the run was made; may be empty
  std::optional<Camera> camera;   ///< with which the run was made, when it tells its numbers
  std::string camera_name;        ///< a name or a file; empty when the run does not tell
  std::string variant;
  std::optional<int> frames, tracked;
  bool interrupted = false;            ///< it ended before the sequence did
  std::optional<int> sequence_frames;  ///< of the whole sequence, when the run tells
  std::optional<double> peak_memory_mb;
};

/// How a fault of a run is mended, as a rule.
inline constexpr const char* kRunAgain = "run the SLAM system again";

/// Reads run.json; one that is missing tells nothing, which is a flaw.
RunInfo ReadRunInfo(Folder& folder);

}  // namespace eval
