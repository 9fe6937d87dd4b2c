#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sim {

/// Rigid motion T_ab: takes coordinates in b to coordinates in a, x_a = R x_b + t.
/// Frames of the simulator: w world (z up), c camera (x right, y down, z forward), o object.
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();  ///< metres

  Eigen::Vector3d operator*(const Eigen::Vector3d& x_b) const { return R * x_b + t; }
  Pose operator*(const Pose& T_bc) const { return {R * T_bc.R, R * T_bc.t + t}; }
};

/// T_ba of T_ab.
inline Pose Inverse(const Pose& T_ab) {
  return {T_ab.R.transpose(), -(T_ab.R.transpose() * T_ab.t)};
}

}  // namespace sim
