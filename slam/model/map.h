#pragma once

#include <vector>

#include "slam/model/keyframe.h"
#include "slam/model/manhattan_frame.h"
#include "slam/model/map_planes.h"
#include "slam/model/map_point.h"

namespace slam {

/// All that the estimator knows of the world. World frame: the first tracked camera.
struct Map {
  std::vector<Keyframe> keyframes;
  std::vector<MapPoint> points;
  MapPlanes planes;  ///< candidates, landmarks and those merged into others
  std::vector<ManhattanFrame> manhattan;  ///< see slam/structure; empty without an assumption
};

}  // namespace slam
