#pragma once

#include "slam/geometry/pose.h"

namespace slam {

/// A pose and what is known of it: covariance of xi in T_cw <- Exp(xi) T_cw, metres and radians.
struct UncertainPose {
  Pose T_cw;
  Matrix6d covariance = Matrix6d::Zero();
};

/// A camera's speed: T_cw <- Exp(dt speed) T_cw in the next dt seconds; m/s and rad/s.
struct UncertainSpeed {
  Vector6d mean = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();
};

/// A direction of the camera's motion.
struct MotionAxis {
  bool turn = false;       ///< about the axis; else along it
  Eigen::Vector3d axis_c;  ///< unit, camera frame; its sign says nothing
};

}  // namespace slam
