#include "slam/pose/factors/point_plane.h"

namespace slam {

Linearised<1> PointPlaneFactor(const PointPlaneConstraint& constraint, const Pose& T_cw) {
  Linearised<1> out;
  const Eigen::Vector3d x_c = T_cw * constraint.p_w;
  out.r[0] = SignedDistance(constraint.pi_c, x_c);  // eq18
  out.J.leftCols<3>() = constraint.pi_c.n.transpose();
  out.J.rightCols<3>() = x_c.cross(constraint.pi_c.n).transpose();
  out.valid = true;
  return out;
}

}  // namespace slam
