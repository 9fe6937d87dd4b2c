#pragma once

#include <vector>

#include "slam/model/map.h"

namespace slam {

/// The part of the map around the camera.
struct LocalMap {
  int reference = kNone;       ///< keyframe that shares the most points with the frame
  std::vector<int> keyframes;  ///< most shared points first, then neighbours of those
  std::vector<int> points;     ///< ids, ascending
};

/// Keyframes that see the frame's matched points, their nearest neighbours, and the points of
/// all.
/// @param max_keyframes bounds the work; at least 1
LocalMap GatherLocalMap(const Frame& frame, const Map& map, int max_keyframes);

}  // namespace slam
