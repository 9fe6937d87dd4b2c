#pragma once

#include <vector>

#include "slam/model/frame.h"
#include "slam/model/map.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// How far off the world the map may lie that is seen from T_cw: a keyframe's covariance, carried there;
/// as xi in T_cw <- Exp(xi) T_cw.
/// @param keyframe  that the frame stands by
Matrix6d MapCovarianceAt(const Pose& T_cw, const Map& map, int keyframe);

/// The keyframe that shows the most landmarks that the frame shows, the oldest of several; kNone
/// where none shows any.
int KeyframeByPlanes(const Frame& frame, const Map& map);

/// How far off the world the map may lie that the planes of a frame show: as far as at KeyframeByPlanes,
/// and along their normals as far as the planes themselves. A plane that came into view where the camera
/// had gone astray shows that part of the map, even if most of the others are old.
/// @param planes  that the pose was found by
Matrix6d MapCovarianceByPlanes(const Frame& frame, const Map& map,
                               const std::vector<PlaneConstraint>& planes);

}  // namespace slam
