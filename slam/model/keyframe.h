#pragma once

#include <map>
#include <vector>

#include "slam/model/found_place.h"
#include "slam/model/frame.h"
#include "slam/model/measured_plane.h"
#include "slam/model/plane_estimate.h"

namespace slam {

/// What a keyframe knows of a map plane: it has seen it, or frames that are tied to it have. The
/// plane is what seen_c comes to, all errors included.
struct KeyframePlane : MeasuredPlane {
  int map_plane = kNone;  ///< id, as it was associated; kNone: taken back as wrong
  PlaneEstimate seen_c;   ///< in the keyframe's camera
  // What its own frame alone saw: errors of edges stay from frame to frame.
  std::vector<MeasuredPlane> edges;  ///< planes supposed at the surface's straight edges
  std::vector<Vertex> vertices_c;    ///< corners that were seen, not extrapolated
};

/// A frame kept in the map. `id` is its index in Map::keyframes and is never reused.
struct Keyframe {
  int id = 0;
  int frame_index = 0;
  double timestamp_s = 0.0;
  Pose T_cw;
  Readout readout;
  /// What was known of its pose in the world when it was made (CovarianceInWorld): so far off may lie what
  /// was mapped from here. Of xi in T_cw <- Exp(xi) T_cw.
  Matrix6d covariance = Matrix6d::Zero();
  FoundPlace found;       ///< what its frame told of the one before
  bool by_points = true;  ///< points hold its pose; else planes do
  std::vector<PointFeature> features;
  std::vector<int> map_points;  ///< parallel to features: map point id or kNone
  std::vector<KeyframePlane> planes;
  std::map<int, int> covisible;  ///< keyframe id -> shared map points
  bool culled = false;           ///< then without features and planes
  int parent = kNone;            ///< when culled: the keyframe that its pose now follows ...
  Pose T_cp;                     ///< ... and where it stands as seen from that one
};

}  // namespace slam
