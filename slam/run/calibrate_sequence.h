#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "slam/calibrate/warp_learner.h"
#include "slam/run/config.h"
#include "slam/run/run_sequence.h"

namespace slam {

/// What is calibrated.
struct CalibrateOptions {
  std::filesystem::path sequence;
  std::string camera;  ///< tum1, tum2, tum3, a file; empty: the sequence's camera.yaml
  Config config;
  int frames = 0;              ///< at most so many; 0 = all
  TellPass progress;           ///< of "tracking", "planes" and "planes again"; may be empty
  std::function<bool()> stop;  ///< asked after each frame; when true it ends. May be empty
};

/// What a recording tells of its device.
struct Calibration {
  DepthWarp warp;
  WarpEvidence evidence;
  int tracked = 0;  ///< frames
  bool stopped = false;
  std::vector<std::string> warnings;  ///< of the camera file, the recording and its images
};

/// Learns the warp of a device from a recording, in three passes: the camera is tracked by
/// points; planes are found and learnt from; and once more, on depth that is straightened by
/// what was learnt, which leaves large surfaces whole. Repeated images are left out. Deterministic.
/// @throws InputError for bad input
Calibration CalibrateSequence(const CalibrateOptions& options);

}  // namespace slam
