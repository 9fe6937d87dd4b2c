#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "slam/pose/pose_problem.h"

namespace slam {

/// A direction of the world as a camera measured it.
struct AxisObservation {
  Eigen::Vector3d axis_w, n_c;  ///< unit
  double sigma_rad = 0.01;
};

/// The rotation that brings the axes onto what was measured of them, by least squares (Wahba's
/// problem, by Gauss and Newton from `R_cw`), with its information. What the axes do not say is
/// left as in `R_cw` and has no information: with one axis, the turn about it. None without
/// axes, or where one lies far from what was measured of it.
std::optional<RotationConstraint> RotationFromAxes(const std::vector<AxisObservation>& axes,
                                                   const Eigen::Matrix3d& R_cw);

}  // namespace slam
