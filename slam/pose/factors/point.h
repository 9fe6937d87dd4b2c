#pragma once

#include "slam/geometry/camera.h"
#include "slam/pose/factors/linearised.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// f_p of a point x_c in the camera frame, in standard deviations:
///   r = ( (fx x/z + cx - u) / sigma_px,  (fy y/z + cy - v) / sigma_px,
///         z_m^2 (1/z - 1/z_m) / depth_sigma_m ),  (x, y, z) = x_c
/// The third row is the error of the measured depth z_m to first order, in inverse depth, which a
/// step of the camera changes more evenly; zero without depth.
/// Source: PAS-SLAM eq14, whose third row weighs depth by a virtual stereo camera's disparity,
/// whatever the sensor.
struct PointResidual {
  Eigen::Vector3d r = Eigen::Vector3d::Zero();
  Eigen::Matrix3d by_x_c = Eigen::Matrix3d::Zero();
  bool valid =
      false;  ///< false: nearer than kMinProjectedDepth_m to the image plane, or behind
};
PointResidual ResidualOf(const PointConstraint& constraint, const Eigen::Vector3d& x_c,
                         const Camera& camera);

/// The same of the constraint's point by the pose.
Linearised<3> PointFactor(const PointConstraint& constraint, const Pose& T_cw,
                          const Camera& camera);

}  // namespace slam
