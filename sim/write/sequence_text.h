#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/shapes/planes.h"
#include "sim/write/simulator.h"

namespace sim {

/// A time as file names and lists print it: seconds, six decimals.
std::string TimeText(double timestamp_s);
/// The number that TimeText shows.
double PrintedTime(double timestamp_s);

/// Texts of a sequence that are known before the first frame, by path inside the folder:
/// camera.yaml, rgb.txt, depth.txt, associations.txt, groundtruth.txt, gt/scene.json; and, when
/// the calibration errs, gt/camera.yaml, the camera as it is; and, when depth bends,
/// gt/depth_warp.png (docs/sensors.md).
/// @param planes  all of the scene
std::map<std::string, std::string> FixedFiles(const Scene& scene,
                                              const std::vector<ScenePlane>& planes,
                                              const RigOptions& rig,
                                              const std::vector<Shot>& shots);

}  // namespace sim
