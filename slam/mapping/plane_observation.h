#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/mapping/plane_map_config.h"
#include "slam/model/frame.h"
#include "slam/model/map_plane.h"

namespace slam {

/// A candidate before its first observation.
MapPlane StartPlane(const FramePlane& plane, const Frame& frame);

/// Adds one frame plane to the map plane that it shows, at the final frame.T_cw: parameters,
/// clouds, outline, class belief, corners and counts.
void ObservePlane(MapPlane& map_plane, const FramePlane& plane, const Frame& frame,
                  const PlaneMapConfig& config);

std::vector<Eigen::Vector3d> PointsInWorld(const std::vector<Eigen::Vector3d>& points_c,
                                           const Pose& T_wc);

}  // namespace slam
