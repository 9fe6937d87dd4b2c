#pragma once

#include "slam/geometry/camera.h"
#include "slam/pose/factors/linearised.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// f_p: predicted minus measured feature, pixels.
///   r = ( fx x/z + cx - u,  fy y/z + cy - v,  fx x/z + cx - bf/z - u_right )
/// with (x, y, z) = T_cw p_w. The third row is zero for a feature without depth
/// (right_u_px < 0). Not valid for a point nearer than kMinProjectedDepth_m to the image plane
/// or behind it. Pixels are undistorted.
/// @param bf_px_m  focal length times baseline of the virtual right camera
/// Source: PAS-SLAM eq14.
Linearised<3> PointFactor(const PointConstraint& constraint, const Pose& T_cw,
                          const Camera& camera, double bf_px_m);

}  // namespace slam
