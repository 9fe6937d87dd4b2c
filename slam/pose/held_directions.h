#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/geometry/uncertain_pose.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// The directions in which a pose is held by its prediction: measuring took less than half of
/// the prediction's variance away. Those along axes come first, the least known first.
/// @param predicted, estimated  covariance of xi in T_cw <- Exp(xi) T_cw before and after
std::vector<MotionAxis> HeldByPrediction(const Matrix6d& predicted, const Matrix6d& estimated);

/// Steps of the camera that no plane tells: along them each lies, within ten degrees. What planes
/// say of such a step comes from errors of their normals, which stay from frame to frame and would
/// add up. By the landmarks' normals, which stay, so that the same step is unseen in the next frame.
/// @param R_cw  of the camera. @returns unit vectors, camera frame
std::vector<Eigen::Vector3d> UnseenSteps(const std::vector<PlaneConstraint>& planes,
                                         const Eigen::Matrix3d& R_cw);

/// A prediction that is certain of the camera's place along these steps.
UncertainPose HeldAlong(const UncertainPose& predicted,
                        const std::vector<Eigen::Vector3d>& steps_c);

/// The information without what it says along these steps.
Matrix6d WithoutSteps(const Matrix6d& information, const std::vector<Eigen::Vector3d>& steps_c);

}  // namespace slam
