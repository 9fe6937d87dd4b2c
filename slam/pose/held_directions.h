#pragma once

#include <vector>

#include "slam/geometry/uncertain_pose.h"

namespace slam {

/// The directions in which a pose is held by its prediction: measuring took less than half of
/// the prediction's variance away. Those along axes come first, the least known first.
/// @param predicted, estimated  covariance of xi in T_cw <- Exp(xi) T_cw before and after
std::vector<MotionAxis> HeldByPrediction(const Matrix6d& predicted, const Matrix6d& estimated);

}  // namespace slam
