#include "slam/mapping/local_mapping.h"

namespace slam {

LocalMappingReport MapLocally(Map& map, int keyframe, const Camera& camera,
                              const FeatureScale& scale, const LocalMappingConfig& config,
                              const MapTurn& turn) {
  LocalMappingReport report;
  turn([&] { report.culled_points = CullYoungPoints(map, keyframe, config.culling); });
  turn([&] {
    report.triangulated = TriangulatePoints(map, keyframe, camera, scale, config.triangulation);
  });
  turn([&] {
    report.fused = FusePoints(map, keyframe, camera, scale, config.fusion);
    UpdateCovisibility(map, keyframe, config.keyframes);
  });
  report.bundle = AdjustLocalBundle(map, keyframe, camera, scale, config.bundle, turn);
  turn([&] {
    UpdateCovisibility(map, keyframe, config.keyframes);
    report.culled_keyframes = CullKeyframes(map, keyframe, camera, scale, config.keyframes);
  });
  return report;
}

}  // namespace slam
