#pragma once

#include "slam/pose/factors/linearised.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// f_pi_p: a map plane parallel to a frame plane.
///   r = turn from n_c to +-R_cw n_w [rad], the sign that makes it at most a right angle
/// The sign is free because two faces of a room or of a box may look at each other.
/// Source: PAS-SLAM eq19 (corrected: the same regular chart as for eq16).
Linearised<3> ParallelFactor(const DirectionConstraint& constraint, const Pose& T_cw);

}  // namespace slam
