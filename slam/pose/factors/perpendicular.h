#pragma once

#include "slam/pose/factors/linearised.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// f_pi_v: a map plane perpendicular to a frame plane; one degree of freedom.
///   r = asin(n_c . R_cw n_w) [rad]
/// Source: PAS-SLAM eq20 (corrected: the printed R_perp n_c is not unique).
Linearised<1> PerpendicularFactor(const DirectionConstraint& constraint, const Pose& T_cw);

}  // namespace slam
