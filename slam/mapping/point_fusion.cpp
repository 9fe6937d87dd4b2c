#include "slam/mapping/point_fusion.h"

#include <algorithm>
#include <vector>

#include "slam/base/index.h"
#include "slam/features/match_features.h"
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

/// Feature of the keyframe that the point falls on and looks like; kNone when there is none.
int FeatureAt(const MapPoint& point, const Keyframe& keyframe, const FeatureGrid& grid,
              const Camera& camera, const PointFusionConfig& config) {
  constexpr double kRangeMargin = 1.2;
  const Eigen::Vector3d p_c = keyframe.T_cw * point.p_w;
  if (!(p_c.z() > 0)) return kNone;
  const double distance = p_c.norm();
  if (!(distance * kRangeMargin >= point.min_distance_m &&
        distance <= kRangeMargin * point.max_distance_m)) {
    return kNone;
  }
  const Eigen::Vector2d u_px = camera.Project(p_c);
  if (!camera.ImageBox().Contains(u_px)) return kNone;
  if (!((keyframe.T_cw.R * point.view_w).dot(p_c) >= config.min_view_cosine * distance)) {
    return kNone;
  }
  const int octave = config.scales.PredictOctave(distance, point.max_distance_m);
  int best = kNone, best_distance = config.max_distance + 1;
  for (const int f : grid.Near(u_px, config.radius_px * config.scales.Scale(octave), octave - 1,
                               octave + 1)) {
    const PointFeature& feature = keyframe.features[Index(f)];
    double error2 = (feature.u_px - u_px).squaredNorm();
    if (feature.depth_m > 0) {
      const double disparity = config.bf_px_m / p_c.z() - config.bf_px_m / feature.depth_m;
      error2 += disparity * disparity;
    }
    const double gate = feature.depth_m > 0 ? config.stereo_chi2 : config.mono_chi2;
    if (!(error2 <= gate * config.scales.Variance(feature.octave))) continue;
    const int bits = DescriptorDistance(point.descriptor, feature.descriptor);
    if (bits < best_distance) best = f, best_distance = bits;
  }
  return best;
}

int FuseInto(Map& map, const std::vector<int>& points, int keyframe, const FeatureGrid& grid,
             const Camera& camera, const PointFusionConfig& config) {
  int fused = 0;
  for (const int id : points) {
    const MapPoint& point = map.points[Index(id)];
    if (point.culled || point.observations.count(keyframe) != 0) continue;
    const int feature = FeatureAt(point, map.keyframes[Index(keyframe)], grid, camera, config);
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
    UpdatePoint(map, kept, config.scales);
    ++fused;
  }
  return fused;
}

}  // namespace

int FusePoints(Map& map, int keyframe, const Camera& camera, const PointFusionConfig& config) {
  int fused = 0;
  const std::vector<int> neighbours = BestCovisible(map, keyframe, config.neighbours);
  const FeatureGrid here(map.keyframes[Index(keyframe)].features, camera);
  for (const int other : neighbours) {
    const FeatureGrid there(map.keyframes[Index(other)].features, camera);
    fused +=
        FuseInto(map, PointsOf(map.keyframes[Index(keyframe)]), other, there, camera, config);
  }
  for (const int other : neighbours) {
    fused +=
        FuseInto(map, PointsOf(map.keyframes[Index(other)]), keyframe, here, camera, config);
  }
  return fused;
}

}  // namespace slam
