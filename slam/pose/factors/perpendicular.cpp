#include "slam/pose/factors/perpendicular.h"

namespace slam {
namespace {

// Below, the two normals are parallel: the constraint is nonsense and has no gradient.
constexpr double kMinCross = 1e-6;  // sine of the angle

}  // namespace

Linearised<1> PerpendicularFactor(const DirectionConstraint& constraint, const Pose& T_cw) {
  Linearised<1> out;
  const Eigen::Vector3d n_p = T_cw.R * constraint.n_w;
  const Eigen::Vector3d cross = n_p.cross(constraint.n_c);
  const double s = cross.norm();
  if (!(s > kMinCross)) return out;
  out.r[0] = std::atan2(constraint.n_c.dot(n_p), s);  // eq20; asin, exact also near pi/2
  out.J.rightCols<3>() = (cross / s).transpose();
  out.valid = true;
  return out;
}

}  // namespace slam
