#include "slam/pose/factors/parallel.h"

#include "slam/pose/factors/plane.h"

namespace slam {

Linearised<3> ParallelFactor(const DirectionConstraint& constraint, const Pose& T_cw) {
  Linearised<3> out;
  Eigen::Vector3d n_p = T_cw.R * constraint.n_w;
  if (n_p.dot(constraint.n_c) < 0) n_p = -n_p;
  const NormalDifference turn = TurnBetween(constraint.n_c, n_p);
  if (!turn.valid) return out;
  out.r = turn.r;  // eq19
  out.J.rightCols<3>() = -turn.dr_dn2 * Hat(n_p);
  out.valid = true;
  return out;
}

}  // namespace slam
