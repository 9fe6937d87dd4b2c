#pragma once

#include <vector>

#include "slam/model/keyframe.h"
#include "slam/model/map_plane.h"
#include "slam/model/map_point.h"

namespace slam {

/// All that the estimator knows of the world. World frame: the first tracked camera.
struct Map {
  std::vector<Keyframe> keyframes;
  std::vector<MapPoint> points;
  std::vector<MapPlane> planes;
  /// Surfaces on trial: seen, but not often enough to be landmarks. `id` is the index here and
  /// changes when others leave.
  std::vector<MapPlane> plane_candidates;
};

}  // namespace slam
