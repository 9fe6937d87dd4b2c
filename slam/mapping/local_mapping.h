#pragma once

#include "slam/mapping/bundle/local_bundle.h"
#include "slam/mapping/keyframes.h"
#include "slam/mapping/map_points.h"
#include "slam/mapping/point_fusion.h"
#include "slam/mapping/point_triangulation.h"

namespace slam {

/// Settings of local mapping by points.
struct LocalMappingConfig {
  KeyframeConfig keyframes;
  PointCullingConfig culling;
  TriangulationConfig triangulation;
  PointFusionConfig fusion;
  LocalBundleConfig bundle;
};

/// Brings the map around a new keyframe in order: young points are culled, points triangulated
/// and fused, poses and points adjusted, keyframes that add nothing culled.
/// Source: Mur-Artal and Tardos 2017, local mapping.
void MapLocally(Map& map, int keyframe, const Camera& camera, const FeatureScale& scale,
                const LocalMappingConfig& config, const MapTurn& turn = AtOnce);

}  // namespace slam
