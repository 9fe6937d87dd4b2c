#pragma once

#include <vector>

#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// M_c: the frame's features with depth that lie on each frame plane's pixels, in the world at
/// T_cw. Outer index: frame plane.
std::vector<std::vector<Eigen::Vector3d>> FeaturesOnPlanes(const Frame& frame, const Pose& T_cw,
                                                           const Camera& camera);

/// M_w: the points of a map plane that the camera at T_cw would see: in the picture, where depth is
/// measured, and not hidden by it. Comparing with everything ever seen would fail a match seen by
/// half.
std::vector<Eigen::Vector3d> VisibleMapPoints(const MapPlane& map_plane, const Map& map,
                                              const Frame& frame, const Pose& T_cw,
                                              const Camera& camera);

}  // namespace slam
