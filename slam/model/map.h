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
};

}  // namespace slam
