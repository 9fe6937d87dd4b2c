#pragma once

#include "slam/base/field_visitor.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map.h"

namespace slam {

/// When two points are one.
struct PointFusionConfig {
  double radius_px = 3.0;
  int max_distance = 50;  // Mur-Artal, Montiel, Tardos 2015, for matches that must be sure
  int neighbours = 8;
};

inline void VisitFields(PointFusionConfig& c, FieldVisitor& v) {
  v.Number("radius_px", c.radius_px, "(0, inf)",
           "radius of the search around the projected point, at octave 0");
  v.Integer("max_distance", c.max_distance, "[0, 256]",
            "largest number of bits in which the two descriptors differ");
  v.Integer("neighbours", c.neighbours, "[0, 1000]",
            "number of covisible keyframes that points are exchanged with");
}

/// Projects the points of `keyframe` into covisible keyframes and theirs into it. Where a point
/// meets a feature like it, the feature becomes an observation, or, if it has a point of its
/// own, the one with fewer observations is fused into the other. @returns fusions and
/// observations.
int FusePoints(Map& map, int keyframe, const Camera& camera, const FeatureScale& scale,
               const PointFusionConfig& config);

}  // namespace slam
