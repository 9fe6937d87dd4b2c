#pragma once

#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// The keyframe that shows the most landmarks that the frame shows, the oldest of several; kNone
/// where none shows any.
int KeyframeByPlanes(const Frame& frame, const Map& map);

/// Covariance of the frame's pose in the world, as xi in T_cw <- Exp(xi) T_cw. The pose is found towards
/// the map; but it is no better known than the keyframe it stands by was when the map was made there:
/// after a way along a blank wall all that is mapped next lies as far off as the camera may have gone.
/// @param keyframe  that the frame stands by
Matrix6d CovarianceInWorld(const Frame& frame, const Map& map, int keyframe);

}  // namespace slam
