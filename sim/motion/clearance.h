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
};

/// The distance to a box is exact. A body of another shape may be hollow, with the camera within it.
enum class PassKind { kBox, kBody };

/// Infinitely far where the scene has nothing of the kind.
/// @pre the trajectory is not empty
NearestPass NearestPassOf(const Scene& scene, const std::vector<TimedPose>& trajectory,
                          PassKind kind);

/// What a user should know of a trajectory that comes too near; empty when none does.
/// @throws InputError when the camera is inside a box, where it would see nothing true
std::string ClearanceWarning(const Scene& scene, const std::vector<TimedPose>& trajectory);

}  // namespace sim
