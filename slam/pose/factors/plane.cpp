#include "slam/pose/factors/plane.h"

namespace slam {
namespace {

// From here to pi the direction of the turn is noise: the pair is refused.
constexpr double kMaxTurn_rad = 3.1415926535897932 - 1e-6;
// Below, the closed forms lose digits to cancellation; the series are exact to 1e-12.
constexpr double kSmallTurn_rad = 3e-3;

}  // namespace

NormalDifference TurnBetween(const Eigen::Vector3d& n_1, const Eigen::Vector3d& n_2) {
  NormalDifference out;
  const Eigen::Vector3d cross = n_1.cross(n_2);
  const double s = cross.norm(), c = n_1.dot(n_2);
  const double theta = std::atan2(s, c);
  if (!(theta < kMaxTurn_rad)) return out;
  // f = theta / sin(theta) and df/dc on the sphere, where c = cos(theta).
  const double theta2 = theta * theta;
  const bool small = theta < kSmallTurn_rad;
  const double f = small ? 1 + theta2 / 6 : theta / s;
  const double df_dc = small ? -1.0 / 3 - theta2 * 2 / 15 : (theta * c / s - 1) / (s * s);
  out.r = f * cross;
  out.dr_dn2 = f * Hat(n_1) + df_dc * cross * n_1.transpose();
  out.valid = true;
  return out;
}

Linearised<4> PlaneFactor(const PlaneConstraint& constraint, const Pose& T_cw) {
  Linearised<4> out;
  const Eigen::Vector3d n_p = T_cw.R * constraint.pi_w.n;  // eq15
  const double d_p = constraint.pi_w.d - T_cw.t.dot(n_p);
  const NormalDifference turn = TurnBetween(constraint.pi_c.n, n_p);  // eq16
  if (!turn.valid) return out;
  const Eigen::Vector3d x_c = ProjectOnto(constraint.pi_c, constraint.centroid_c);
  out.r.head<3>() = turn.r;
  out.r[3] = n_p.dot(x_c) + d_p;
  out.J.topRightCorner<3, 3>() = -turn.dr_dn2 * Hat(n_p);  // dn_p = omega x n_p
  out.J.bottomLeftCorner<1, 3>() = -n_p.transpose();
  out.J.bottomRightCorner<1, 3>() = n_p.cross(x_c).transpose();
  out.valid = true;
  return out;
}

}  // namespace slam
