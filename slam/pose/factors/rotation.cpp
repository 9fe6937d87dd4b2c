#include "slam/pose/factors/rotation.h"

namespace slam {
namespace {

constexpr double kMaxDifference_rad = 3.0;     // beyond, Log is about to jump
constexpr double kSmallDifference_rad = 1e-4;  // below, the series is exact to 1e-16

/// d Log(Exp(omega) Exp(phi)) / d omega at 0: the inverse of SO(3)'s left Jacobian.
Eigen::Matrix3d InverseLeftJacobian(const Eigen::Vector3d& phi) {
  const double theta = phi.norm();
  const double second = theta < kSmallDifference_rad
                            ? 1.0 / 12
                            : (1 - 0.5 * theta / std::tan(0.5 * theta)) / (theta * theta);
  const Eigen::Matrix3d hat = Hat(phi);
  return Eigen::Matrix3d::Identity() - 0.5 * hat + second * hat * hat;
}

}  // namespace

Linearised<3> RotationFactor(const RotationConstraint& constraint, const Pose& T_cw) {
  Linearised<3> out;
  const Eigen::Vector3d phi = LogSo3(T_cw.R * constraint.R_cw.transpose());
  if (!(phi.norm() < kMaxDifference_rad)) return out;
  out.r = constraint.sqrt_information * phi;
  out.J.rightCols<3>() = constraint.sqrt_information * InverseLeftJacobian(phi);
  out.valid = true;
  return out;
}

}  // namespace slam
