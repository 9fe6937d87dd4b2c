#pragma once

#include <optional>

#include "slam/geometry/pose.h"

namespace slam {

/// A pose and what is known of it: covariance of xi in T_cw <- Exp(xi) T_cw, metres and radians.
struct UncertainPose {
  Pose T_cw;
  Matrix6d covariance = Matrix6d::Zero();
};

/// Covariance of a pose that is known alike along all axes and about all axes.
inline Matrix6d IsotropicCovariance(double sigma_m, double sigma_rad) {
  const double m2 = sigma_m * sigma_m, rad2 = sigma_rad * sigma_rad;
  return (Vector6d() << m2, m2, m2, rad2, rad2, rad2).finished().asDiagonal();
}

/// A camera's speed: T_cw <- Exp(dt speed) T_cw in the next dt seconds; m/s and rad/s.
struct UncertainSpeed {
  Vector6d mean = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();
};

/// What a camera's pose says of its speed, by how it moved before: where it came farther than it was
/// predicted to, it is faster.
struct SpeedByPose {
  Pose predicted_cw;
  Vector6d speed = Vector6d::Zero();       ///< at the predicted pose
  Matrix6d gain = Matrix6d::Zero();        ///< 1/s, by xi in T_cw <- Exp(xi) T_cw
  Matrix6d covariance = Matrix6d::Zero();  ///< of the speed at a pose that is known

  Vector6d At(const Pose& T_cw) const {
    return speed + gain * Log(T_cw * Inverse(predicted_cw));
  }
};

/// What a frame says of how its camera moves: J^T W J for T <- Exp(xi) T.
struct MotionEvidence {
  Matrix6d of_pose = Matrix6d::Zero();  ///< by what was measured at the pose's time
  Matrix6d of_late_pose =
      Matrix6d::Zero();  ///< of the pose late_s later, by planes of that time
  double late_s = 0.0;
  std::optional<Vector6d> speed = {};  ///< found with these; none: as the pose says
};

/// A direction of the camera's motion.
struct MotionAxis {
  bool turn = false;       ///< about the axis; else along it
  Eigen::Vector3d axis_c;  ///< unit, camera frame; its sign says nothing
};

}  // namespace slam
