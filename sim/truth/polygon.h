#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/base/pose.h"
#include "sim/camera/camera.h"
#include "sim/scene/scene.h"
#include "sim/shapes/planes.h"

namespace sim {

/// Corners of a convex polygon in order; the last joins the first.
using Polygon = std::vector<Eigen::Vector2d>;

/// What lies on the side normal . x <= offset.
Polygon CutAt(const Polygon& polygon, const Eigen::Vector2d& normal, double offset);

/// What both convex polygons cover; either may run either way round.
Polygon Overlap(const Polygon& a, const Polygon& b);

/// Where two convex polygons are closest, first the point of a; equal when they overlap or
/// touch.
struct ClosestPoints {
  Eigen::Vector2d on_a, on_b;
  double distance = 0;
};
ClosestPoints Closest(const Polygon& a, const Polygon& b);

/// Signed: positive when the corners run anticlockwise with v to the left of u.
double SignedArea(const Polygon& polygon);

/// The face as the image would show it with nothing before it: its part with
/// z > kSilhouetteNear_m, projected and cut at the image's border, -0.5 to size - 0.5. Empty
/// when the face is outside.
Polygon ProjectedFace(const ScenePlane& plane, const Pose& T_wc, const Camera& camera);

}  // namespace sim
