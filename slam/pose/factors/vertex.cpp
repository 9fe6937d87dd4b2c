#include "slam/pose/factors/vertex.h"

namespace slam {

Linearised<2> VertexFactor(const VertexConstraint& constraint, const Pose& T_cw) {
  Linearised<2> out;
  const Eigen::Vector3d x_c = T_cw * constraint.p_w;
  out.r = constraint.sqrt_information * (x_c - constraint.p_c);
  out.J = constraint.sqrt_information * PointJacobian(x_c);
  out.valid = true;
  return out;
}

}  // namespace slam
