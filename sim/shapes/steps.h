#pragma once

#include <vector>

#include "sim/scene/scene.h"
#include "sim/shapes/planes.h"

namespace sim {

/// How far the top of a regular object stands above what is under it.
struct TopStep {
  int plane = 0;         ///< ScenePlane::id of the top face
  int object = 0;        ///< its owner
  int below_object = 0;  ///< owner of the highest surface under it
  double step_mm = 0;    ///< along the top's normal to the nearest point of that surface; >= 0
};

/// One entry for each upward face (within 10 degrees) of a regular box or mesh that has an upward
/// face of another object under any part of it. In the order of the planes.
/// @param planes  all of the scene
std::vector<TopStep> TopSteps(const Scene& scene, const std::vector<ScenePlane>& planes);

}  // namespace sim
