#include "slam/mapping/local_mapping.h"

namespace slam {

LocalMappingReport MapLocally(Map& map, int keyframe, const Camera& camera,
                              const LocalMappingConfig& config, const MapTurn& turn) {
  LocalMappingReport report;
  turn([&] { report.culled_points = CullYoungPoints(map, keyframe, config.culling); });
  turn([&] {
    report.triangulated = TriangulatePoints(map, keyframe, camera, config.triangulation);
  });
  turn([&] {
    report.fused = FusePoints(map, keyframe, camera, config.fusion);
    UpdateCovisibility(map, keyframe, config.keyframes);
  });
  report.bundle = AdjustLocalBundle(map, keyframe, camera, config.bundle, turn);
  turn([&] {
    UpdateCovisibility(map, keyframe, config.keyframes);
    report.culled_keyframes = CullKeyframes(map, keyframe, camera, config.keyframes);
  });
  return report;
}

}  // namespace slam
