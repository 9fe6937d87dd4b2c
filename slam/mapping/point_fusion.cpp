#include "slam/mapping/point_fusion.h"

#include <algorithm>
#include <vector>

#include "slam/base/index.h"
#include "slam/features/match_features.h"
#include "slam/features/point_projection.h"
#include "slam/mapping/keyframes.h"
#include "slam/mapping/map_points.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

std::vector<int> PointsOf(const Keyframe& keyframe) {
  std::vector<int> points;
  for (const int point : keyframe.map_points) {
    if (point != kNone) points.push_back(point);
  }
  return points;
}

/// What points are looked for with, in whatever keyframe.
struct Search {
  const Camera& camera;
  const FeatureScale& scale;
  const PointFusionConfig& config;
};

/// Feature of the keyframe that the point falls on and looks like; kNone when there is none.
int FeatureAt(const MapPoint& point, const Keyframe& keyframe, const FeatureGrid& grid,
              const Search& search) {
  const auto view = ExpectView(point, keyframe.T_cw, search.camera, search.scale);
  if (!view) return kNone;
  const Eigen::Vector3d p_c = keyframe.T_cw * point.p_w;
  int best = kNone, best_distance = search.config.max_distance + 1;
  for (const int f :
       grid.Near(view->u_px, search.config.radius_px * search.scale.Scale(view->octave),
                 view->octave - 1, view->octave + 1)) {
    const PointFeature& feature = keyframe.features[Index(f)];
    if (!AgreesWith(feature, p_c, search.camera, search.scale)) continue;
    const int bits = DescriptorDistance(point.descriptor, feature.descriptor);
    if (bits < best_distance) best = f, best_distance = bits;
  }
  return best;
}

/// Gives the keyframe the points that it sees too; returns fusions and observations.
int FuseInto(Map& map, const std::vector<int>& points, int keyframe, const FeatureGrid& grid,
             const Search& search) {
  int fused = 0;
  for (const int id : points) {
    const MapPoint& point = map.points[Index(id)];
    if (point.culled || point.observations.count(keyframe) != 0) continue;
    const int feature = FeatureAt(point, map.keyframes[Index(keyframe)], grid, search);
    if (feature == kNone) continue;
    const int there = map.keyframes[Index(keyframe)].map_points[Index(feature)];
    int kept = id;
    if (there == kNone) {
      AddObservation(map, id, keyframe, feature);
    } else if (map.points[Index(there)].observations.size() > point.observations.size()) {
      ReplacePoint(map, id, there);
      kept = there;
    } else {
      ReplacePoint(map, there, id);
    }
    UpdatePoint(map, kept, search.scale);
    ++fused;
  }
  return fused;
}

}  // namespace

int FusePoints(Map& map, int keyframe, const Camera& camera, const FeatureScale& scale,
               const PointFusionConfig& config) {
  const Search search{camera, scale, config};
  int fused = 0;
  const std::vector<int> neighbours = BestCovisible(map, keyframe, config.neighbours);
  const FeatureGrid here(map.keyframes[Index(keyframe)].features, camera);
  for (const int other : neighbours) {
    const FeatureGrid there(map.keyframes[Index(other)].features, camera);
    fused += FuseInto(map, PointsOf(map.keyframes[Index(keyframe)]), other, there, search);
  }
  for (const int other : neighbours) {
    fused += FuseInto(map, PointsOf(map.keyframes[Index(other)]), keyframe, here, search);
  }
  return fused;
}

}  // namespace slam
