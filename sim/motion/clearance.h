#pragma once

#include <string>
#include <vector>

#include "sim/motion/trajectory.h"
#include "sim/scene/scene.h"

namespace sim {

/// The pose of a trajectory that comes nearest to a solid.
struct NearestPass {
  double timestamp_s = 0;
  std::string object;     ///< its name
  double distance_m = 0;  ///< negative inside; bodies other than boxes count as their boxes
  bool box = true;        ///< whether it is a box, so that the distance is exact
};

/// @pre neither is empty
NearestPass NearestPassOf(const Scene& scene, const std::vector<TimedPose>& trajectory);

/// What a user should know of a trajectory that comes too near; empty when none does.
/// @throws InputError when the camera is inside a box, where it would see nothing true
std::string ClearanceWarning(const Scene& scene, const std::vector<TimedPose>& trajectory);

}  // namespace sim
