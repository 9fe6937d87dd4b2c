#pragma once

#include <Eigen/Core>

#include "slam/geometry/plane.h"

namespace slam {

/// A plane as a camera saw it.
struct MeasuredPlane {
  Plane pi_c;
  Eigen::Vector3d centroid_c = Eigen::Vector3d::Zero();  ///< where the offset is known best
  double angle_sigma_rad = 0.01;  ///< standard deviation of the normal ...
  double offset_sigma_m = 0.005;  ///< ... and of the offset there
};

}  // namespace slam
