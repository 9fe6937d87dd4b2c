#pragma once

#include <vector>

#include "sim/scene/scene.h"
#include "sim/sensor/depth/depth_sensor.h"
#include "sim/shapes/planes.h"

namespace sim {

/// Two scored planes that face nearly the same way and lie over or beside each other: what an
/// association could take for one.
struct PlanePair {
  int a = 0, b = 0;           ///< ScenePlane::id, a < b
  double angle_deg = 0;       ///< between the normals
  double lateral_gap_mm = 0;  ///< between the faces seen along a's normal; 0 = they overlap
  double step_mm = 0;  ///< from a to b along a's normal, at the middle of what they share, else
                       ///< where they are closest
  double step_sigmas = 0;  ///< |step| / kPairSigma_m: the smaller, the more ambiguous
};

inline constexpr double kPairMaxAngle_deg = 15.0;
inline constexpr double kPairMaxGap_m = 0.1;
/// Axial noise of the first Kinect at 1 m: a desk's objects are seen from about there.
inline constexpr double kPairSigma_m =
    kAxialFloor_m + kAxialGrowth_per_m * (1 - kAxialNearest_m) * (1 - kAxialNearest_m);

/// All such pairs of planes of structure and regular objects, in the order of (a, b).
/// @param planes  all of the scene
std::vector<PlanePair> PlanePairs(const Scene& scene, const std::vector<ScenePlane>& planes);

}  // namespace sim
