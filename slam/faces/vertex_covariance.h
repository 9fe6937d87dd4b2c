#pragma once

#include "slam/faces/line_error.h"
#include "slam/geometry/camera.h"
#include "slam/model/frame_plane.h"

namespace slam {

/// Covariance of the corner at which two edge lines of a plane meet, m^2, camera frame.
///
/// Both lines lie on the plane, so the corner is the point of the plane on the ray of the pixel
/// u at which they cross in the ideal image: x = r(u) / (g . r(u)), r the ray (x, y, 1). Where
/// the lines cross depends on their errors across themselves at u, and how far along the ray
/// the corner lies on the plane's g (FramePlane::inverse_depth_covariance). The three are
/// independent: contours come from where depth jumps, g from the depth inside. First order.
///
/// @param p_c  the corner, on the plane; z > 0
/// Zero in the lines' part when the lines are parallel in the image.
Eigen::Matrix3d VertexCovariance(const FramePlane& plane, const LineError& line_i,
                                 const LineError& line_j, const Eigen::Vector3d& p_c,
                                 const Camera& camera);

}  // namespace slam
