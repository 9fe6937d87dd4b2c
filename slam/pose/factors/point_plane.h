#pragma once

#include "slam/pose/factors/linearised.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// f_p_pi: distance of a map point to the frame plane that it lies on, metres.
///   r = n_c . (T_cw p_w) + d_c
/// Source: PAS-SLAM eq18.
Linearised<1> PointPlaneFactor(const PointPlaneConstraint& constraint, const Pose& T_cw);

}  // namespace slam
