#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/base/pose.h"
#include "sim/scene/scene.h"

namespace sim {

/// Objects may touch; interpenetration up to this is rounding, not a fault.
inline constexpr double kTouch_m = 1e-4;

/// T_wo of the object; its origin is the centre of its box.
Pose ObjectPose(const Object& object);

/// The same of something that moves, at a moment.
Pose ObjectPoseAt(const Object& object, double time_s);

/// The object as it stands at a moment; itself when it does not move.
Object ObjectAt(const Object& object, double time_s);

/// Moments of its way that are never further apart than it moves `step_m`; just 0 when it does
/// not move.
std::vector<double> MomentsOf(const Object& object, double step_m);

/// The eight corners of its box in the world, bit 0 of the index +x, bit 1 +y, bit 2 +z.
std::array<Eigen::Vector3d, 8> Corners(const Object& object);

/// How deep two oriented boxes overlap, metres: the least shift that separates them; negative
/// or zero when apart (then a lower bound of the gap). Toys count as their boxes. Separating
/// axes: 3 + 3 face normals and 9 edge products.
double OverlapDepth(const Object& a, const Object& b);

/// Distance from a point to the solid box, metres; negative inside.
double DistanceToBox(const Object& object, const Eigen::Vector3d& x_w);

}  // namespace sim
