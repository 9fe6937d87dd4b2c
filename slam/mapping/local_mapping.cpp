#include "slam/mapping/local_mapping.h"

namespace slam {

void MapLocally(Map& map, int keyframe, const Camera& camera, const FeatureScale& scale,
                const LocalMappingConfig& config, const MapTurn& turn) {
  turn([&] { CullYoungPoints(map, keyframe, config.culling); });
  turn([&] { TriangulatePoints(map, keyframe, camera, scale, config.triangulation); });
  turn([&] {
    FusePoints(map, keyframe, camera, scale, config.fusion);
    UpdateCovisibility(map, keyframe, config.keyframes);
  });
  AdjustLocalBundle(map, keyframe, camera, scale, config.bundle, turn);
  turn([&] {
    UpdateCovisibility(map, keyframe, config.keyframes);
    CullKeyframes(map, keyframe, camera, scale, config.keyframes);
  });
}

}  // namespace slam
