#pragma once

#include <map>
#include <vector>

#include "slam/model/frame.h"

namespace slam {

/// A frame kept in the map. `id` is its index in Map::keyframes and is never reused.
struct Keyframe {
  int id = 0;
  int frame_index = 0;
  double timestamp_s = 0.0;
  Pose T_cw;
  bool by_points = true;  ///< points hold its pose; else planes do
  std::vector<PointFeature> features;
  std::vector<int> map_points;   ///< parallel to features: map point id or kNone
  std::map<int, int> covisible;  ///< keyframe id -> shared map points
  bool culled = false;           ///< then without features
  int parent = kNone;            ///< when culled: the keyframe that its pose now follows ...
  Pose T_cp;                     ///< ... and where it stands as seen from that one
};

}  // namespace slam
