#pragma once

#include "slam/model/map_plane.h"

namespace slam {

/// Moves the plane as a rigid whole: parameters, estimate, cloud, corners, outline, parts.
/// @param T_new_old  from where it was to where it is, both in the world
void MovePlane(MapPlane& plane, const Pose& T_new_old);

/// The same for a plane supposed at an edge.
void MoveSupposed(SupposedPlane& plane, const Pose& T_new_old);

/// T_new_old of the smallest motion that lays one plane on another near x_w: it turns about the
/// foot of x_w, and then shifts along the normal.
Pose MotionBetween(const Plane& from_w, const Plane& to_w, const Eigen::Vector3d& x_w);

}  // namespace slam
