#pragma once

#include <vector>

#include "slam/features/match_features.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map.h"

namespace slam {

/// What is remembered of the frame before, for tracking the next one.
struct LastFrame {
  std::vector<PointFeature> features;
  std::vector<int> map_points;  ///< parallel to features
  int reference = kNone;        ///< keyframe against which the pose is kept
  Pose T_cr;                    ///< so that the frame follows when mapping moves the keyframe
};

/// Where a feature of the last frame is in the world.
struct SeenPoint {
  int map_point = kNone;  ///< kNone: known from the last frame's depth alone
  int feature = kNone;    ///< index into the last frame's features
  Eigen::Vector3d p_w;
};

/// The last frame's pose in the map as it is now.
Pose LastPose(const LastFrame& last, const Map& map);

/// All that the last frame knows: its matched map points, then those of its unmatched features
/// that have a depth up to `close_m` (Mur-Artal and Tardos 2017, III-B), the nearest
/// `max_temporary` of them.
std::vector<SeenPoint> SeenPoints(const LastFrame& last, const Map& map, const Camera& camera,
                                  double close_m, int max_temporary);

/// Queries for these points from a predicted pose; `point` is the index into `seen`. Points
/// that would fall outside the image are left out.
/// @param radius_px  at octave 0; grows with the octave
std::vector<PointQuery> QueriesOf(const std::vector<SeenPoint>& seen, const LastFrame& last,
                                  const Pose& T_cw, const Camera& camera,
                                  const FeatureScale& scale, double radius_px);

}  // namespace slam
