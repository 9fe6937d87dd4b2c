#pragma once

#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// The keyframe that shows the most landmarks that the frame shows, the oldest of several; kNone
/// where none shows any.
int KeyframeByPlanes(const Frame& frame, const Map& map);

/// How far off the world the map may lie that is seen from T_cw: a keyframe's covariance, carried there;
/// as xi in T_cw <- Exp(xi) T_cw.
/// @param keyframe  that the frame stands by
Matrix6d MapCovarianceAt(const Pose& T_cw, const Map& map, int keyframe);

}  // namespace slam
