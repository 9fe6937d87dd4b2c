#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/base/pose.h"

namespace sim {

/// Where the camera is, what it looks at, and how it is rolled about its axis: a knot of the
/// path, or a point of it.
struct View {
  Eigen::Vector3d camera_w = Eigen::Vector3d::Zero();
  Eigen::Vector3d gaze_w = Eigen::Vector3d::Zero();
  double roll_deg = 0;
};

/// T_wc of a view: z to the gaze, x level but for the roll. The gaze may not be straight above
/// or below the camera.
Pose PoseOf(const View& view);

/// Uniform cubic B-spline between the middle two of four views, `u` in [0, 1]; C2 from one to
/// the next.
View Blend(const std::array<View, 4>& knots, double u);

/// The same spline through many views, `at` knots from its beginning: whole numbers are knots, and
/// the last place is `knots.size() - 3`.
View Along(const std::vector<View>& knots, double at);

/// Angle of the rotation between two poses, degrees.
double TurnBetween_deg(const Pose& a, const Pose& b);

}  // namespace sim
