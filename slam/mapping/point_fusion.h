#pragma once

#include "slam/base/field_visitor.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map.h"

namespace slam {

/// When two points are one.
struct PointFusionConfig {
  double radius_px = 3.0;  ///< search around the projection, octave 0
  int max_distance = 50;   ///< differing bits of the descriptors
  int neighbours = 8;      ///< keyframes tried; domain [0, inf)
};

inline void VisitFields(PointFusionConfig& c, FieldVisitor& v) {
  v.Number("radius_px", c.radius_px, "(0, inf)", "search around the projection, octave 0");
  v.Integer("max_distance", c.max_distance, "[0, 256]", "differing bits");
  v.Integer("neighbours", c.neighbours, "[0, 1000]", "keyframes tried");
}

/// Projects the points of `keyframe` into covisible keyframes and theirs into it. Where a point
/// meets a feature like it, the feature becomes an observation, or, if it has a point of its
/// own, the one with fewer observations is fused into the other. @returns fusions and
/// observations.
int FusePoints(Map& map, int keyframe, const Camera& camera, const FeatureScale& scale,
               const PointFusionConfig& config);

}  // namespace slam
