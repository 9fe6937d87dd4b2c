#pragma once

#include "slam/geometry/camera.h"
#include "slam/model/map.h"
#include "slam/model/scale_pyramid.h"

namespace slam {

/// When two points are one.
struct PointFusionConfig {
  ScalePyramid scales;
  double bf_px_m = 40.0;   ///< b f of the virtual right camera
  double radius_px = 3.0;  ///< search around the projection, octave 0
  int max_distance = 50;   ///< differing bits of the descriptors
  double min_view_cosine = 0.5;
  double stereo_chi2 = 7.815, mono_chi2 = 5.991;
  int neighbours = 8;  ///< keyframes tried; domain [0, inf)
};

/// Projects the points of `keyframe` into covisible keyframes and theirs into it. Where a point
/// meets a feature like it, the feature becomes an observation, or, if it has a point of its
/// own, the one with fewer observations is fused into the other. @returns fusions and
/// observations.
int FusePoints(Map& map, int keyframe, const Camera& camera, const PointFusionConfig& config);

}  // namespace slam
