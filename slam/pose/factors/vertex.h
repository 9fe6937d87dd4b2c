#pragma once

#include "slam/pose/factors/linearised.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// f_v: a corner of a map plane where it should be seen against the corner that was measured,
/// along the frame plane and in standard deviations; what lies across the plane is f_pi's.
///   r = S (T_cw p_w - p_c)
Linearised<2> VertexFactor(const VertexConstraint& constraint, const Pose& T_cw);

}  // namespace slam
