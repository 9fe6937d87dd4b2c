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
  PointMatchConfig match{50, 0.9};
  double radius_factor = 3.0;
  double min_likeness_ratio = 0.8;  // ORB-SLAM2: 1
  int min_inliers = 40;             // ORB-SLAM2
  // A larger correction than can have drifted means another place that looks the same. The
  // bounds balance long loops against such places.
  double base_drift_m = 0.10;
  double drift_per_m = 0.05;
  double base_drift_rad = 0.10;
  double drift_rad_per_m = 0.05;
};

inline void VisitFields(LoopDetectionConfig& c, FieldVisitor& v) {
  v.Number("min_likeness_ratio", c.min_likeness_ratio, "[0, inf)",
           "likeness wanted, as a share of the lowest to the keyframe's own neighbours");
  v.Number("radius_factor", c.radius_factor, "(0, inf)",
           "factor on the search radius around the place's points");
  v.Integer("min_inliers", c.min_inliers, "[4, 100000]",
            "map points of the place that agree on one pose, at least");
  v.Number("base_drift_m", c.base_drift_m, "[0, inf)",
           "largest correction of the position on a path of no length, plus ...");
  v.Number("drift_per_m", c.drift_per_m, "[0, inf)",
           "... this for each metre of path since the place was seen");
  v.Degrees("base_drift_deg", c.base_drift_rad, "[0, 180)",
            "largest correction of the rotation on a path of no length, plus ...");
  v.Degrees("drift_deg_per_m", c.drift_rad_per_m, "[0, 180)",
            "... this for each metre of path since the place was seen");
}

/// The place of the map that a keyframe shows, as seen from there.
struct Loop {
  int keyframe = kNone;         ///< the one that came back
  int place = kNone;            ///< the old one it was recognised by
  Pose T_cw;                    ///< pose of `keyframe`, as the place's points say
  std::vector<int> map_points;  ///< the place's, parallel to the keyframe's features
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
