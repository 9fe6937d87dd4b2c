#pragma once

#include <Eigen/Core>
#include <map>

#include "slam/model/frame.h"

namespace slam {

/// A landmark point. `id` is its index in Map::points and is never reused.
struct MapPoint {
  int id = 0;
  Eigen::Vector3d p_w = Eigen::Vector3d::Zero();      ///< metres
  Descriptor descriptor{};                            ///< the observation nearest to all others
  Eigen::Vector3d view_w = Eigen::Vector3d::UnitZ();  ///< unit mean direction, camera to point
  double min_distance_m = 0.0;  ///< range of distances at which ORB's scale can match
  double max_distance_m = 0.0;
  std::map<int, int> observations;  ///< keyframe id -> feature index
  int first_keyframe = 0;
  int visible_count = 1;  ///< frames that should have seen it
  int found_count = 1;    ///< frames that did
  bool culled = false;
  int replaced_by = kNone;  ///< id of the point into which this one was fused
};

}  // namespace slam
