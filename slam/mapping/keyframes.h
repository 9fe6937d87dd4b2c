#pragma once

#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map.h"

namespace slam {

/// What a new keyframe adds, and when an old one is of no more use.
struct KeyframeConfig {
  // Mur-Artal and Tardos 2017 (new points); Mur-Artal, Montiel, Tardos 2015 (all others).
  int min_new_points = 100;
  int min_shared_points = 15;
  double max_redundancy = 0.9;
  int redundant_views = 3;
};

inline void VisitFields(KeyframeConfig& c, FieldVisitor& v) {
  v.Integer("min_new_points", c.min_new_points, "[0, 100000]",
            "points that a keyframe makes even from depths too far to be trusted");
  v.Integer("min_shared_points", c.min_shared_points, "[1, 100000]",
            "map points that two keyframes must share to be covisible");
  v.Number("max_redundancy", c.max_redundancy, "(0, 1]",
           "share of points that others see as well, above which a keyframe is culled");
  v.Integer("redundant_views", c.redundant_views, "[1, 1000]",
            "other keyframes that must see a point for it to count as redundant");
}

/// Keeps the frame in the map: its matched points get an observation, its unmatched features
/// with depth become new points, the nearest first. `frame.map_points` gets the new ids.
/// @returns the id of the keyframe
int InsertKeyframe(Frame& frame, Map& map, const Camera& camera, const FeatureScale& scale,
                   const KeyframeConfig& config);

/// Recounts the points that `keyframe` shares with others, in both directions.
void UpdateCovisibility(Map& map, int keyframe, const KeyframeConfig& config);

/// Culls keyframes around `keyframe` whose points others see as well and no more than an octave coarser;
/// never the first, the newest or the one before it. @returns how many.
int CullKeyframes(Map& map, int keyframe, const Camera& camera, const FeatureScale& scale,
                  const KeyframeConfig& config);

}  // namespace slam
