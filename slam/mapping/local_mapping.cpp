#include "slam/mapping/local_mapping.h"

namespace slam {

LocalMappingReport MapLocally(Map& map, int keyframe, const Camera& camera,
                              const LocalMappingConfig& config) {
  LocalMappingReport report;
  report.culled_points = CullYoungPoints(map, keyframe, config.culling);
  report.triangulated = TriangulatePoints(map, keyframe, camera, config.triangulation);
  report.fused = FusePoints(map, keyframe, camera, config.fusion);
  UpdateCovisibility(map, keyframe, config.keyframes);
  report.bundle = AdjustLocalBundle(map, keyframe, camera, config.bundle);
  UpdateCovisibility(map, keyframe, config.keyframes);
  report.culled_keyframes = CullKeyframes(map, keyframe, camera, config.keyframes);
  return report;
}

}  // namespace slam
