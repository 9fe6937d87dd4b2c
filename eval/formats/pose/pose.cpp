#include "eval/formats/pose/pose.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace eval {

Pose Inverse(const Pose& T_ab) {
  const Eigen::Matrix3d R_ba = T_ab.R.transpose();
  return {R_ba, -(R_ba * T_ab.t)};
}

Eigen::Matrix3d RotationOf(double x, double y, double z, double w) {
  const Eigen::Quaterniond q(w, x, y, z);
  if (!(q.norm() > 1e-9) || !std::isfinite(q.norm())) {
    throw std::invalid_argument("RotationOf: the quaternion has no direction");
  }
  return q.normalized().toRotationMatrix();
}

double AngleOf(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(twice_sine.norm(), R.trace() - 1.0);
}

}  // namespace eval
