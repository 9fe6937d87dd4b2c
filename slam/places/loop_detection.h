#pragma once

#include <optional>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/model/local_map.h"
#include "slam/places/keyframe_index.h"
#include "slam/places/place_search.h"

namespace slam {

/// When a keyframe shows a place that the map holds already.
struct LoopDetectionConfig {
  PointMatchConfig match{50, 0.9, false};
  double radius_factor = 3.0;  ///< on the projection's radius
  /// Likeness wanted, as a share of the least that the keyframe has to its own neighbours;
  /// domain [0, inf)
  double min_likeness_ratio = 0.8;
  int min_inliers = 40;  ///< map points of the place that agree on one pose; domain [4, inf)
  // What may have drifted since: a larger correction is another place that looks the same.
  double base_drift_m = 0.10;  ///< whatever the path
  double drift_per_m = 0.05;   ///< of the path since the place was seen
  double base_drift_rad = 0.10;
  double drift_rad_per_m = 0.05;
};

inline void VisitFields(LoopDetectionConfig& c, FieldVisitor& v) {
  v.Number("min_likeness_ratio", c.min_likeness_ratio, "[0, inf)",
           "of the least likeness to the keyframe's own neighbours");
  v.Number("radius_factor", c.radius_factor, "(0, inf)",
           "on the search radius around the place's points");
  v.Integer("min_inliers", c.min_inliers, "[4, 100000]", "points that agree on one pose");
  v.Number("base_drift_m", c.base_drift_m, "[0, inf)", "a larger correction is refused ...");
  v.Number("drift_per_m", c.drift_per_m, "[0, inf)", "... beyond this share of the path");
  v.Degrees("base_drift_deg", c.base_drift_rad, "[0, 180)", "the same of the turn");
  v.Degrees("drift_deg_per_m", c.drift_rad_per_m, "[0, 180)", "the same of the turn");
}

/// The place of the map that a keyframe shows, as seen from there.
struct Loop {
  int keyframe = kNone;         ///< the one that came back
  int place = kNone;            ///< the old one it was recognised by
  Pose T_cw;                    ///< of `keyframe`, as the place's points say
  std::vector<int> map_points;  ///< of the place, parallel to the keyframe's features
  int inliers = 0;
};

/// Looks for keyframes like this one that are neither covisible with it nor with its
/// neighbours; finds the keyframe's pose from their points alone, then from all points around;
/// refuses two places that fit nearly as well and corrections beyond what can have drifted.
/// Source: Mur-Artal and Tardos 2014 (words), 2017 (SE(3), since depth gives the scale).
/// @param index  up to date with the map
std::optional<Loop> DetectLoop(const Map& map, const KeyframeIndex& index, int keyframe,
                               const Camera& camera, const FeatureScale& scale,
                               const PointSearchConfig& search,
                               const LoopDetectionConfig& config);

}  // namespace slam
