#pragma once

#include <vector>

#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// Finds the frame's matched map points that lie on its good planes: within `max_distance_m`
/// of the plane at frame.T_cw, and seen on the plane's pixels or, where the segment has a hole
/// (print, gloss), inside the detection box that the plane belongs to and inside the plane's
/// own box. In the order of the features. Cost: O(features x planes with a box).
std::vector<PointPlaneMatch> AssociatePointsToPlanes(const Frame& frame, const Map& map,
                                                     const Camera& camera,
                                                     double max_distance_m);

}  // namespace slam
