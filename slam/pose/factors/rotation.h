#pragma once

#include "slam/pose/factors/linearised.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// f_R: the camera's rotation against one that was measured, in standard deviations.
///   r = S Log(R_cw R_m^T),   S^T S = the information of the measured one, 1/rad^2
/// Turns that S leaves out are free. Not valid where the two differ by nearly half a turn.
Linearised<3> RotationFactor(const RotationConstraint& constraint, const Pose& T_cw);

}  // namespace slam
