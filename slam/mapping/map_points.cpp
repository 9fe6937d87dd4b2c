#include "slam/mapping/map_points.h"

#include <limits>
#include <utility>
#include <vector>

#include "slam/base/median.h"
#include "slam/base/require.h"
#include "slam/features/match_features.h"

namespace slam {
namespace {

MapPoint& PointOf(Map& map, int id) { return map.points.at(static_cast<std::size_t>(id)); }
const MapPoint& PointOf(const Map& map, int id) {
  return map.points.at(static_cast<std::size_t>(id));
}
Keyframe& KeyframeOf(Map& map, int id) {
  return map.keyframes.at(static_cast<std::size_t>(id));
}
const Keyframe& KeyframeOf(const Map& map, int id) {
  return map.keyframes.at(static_cast<std::size_t>(id));
}
int& SlotOf(Map& map, int keyframe, int feature) {
  return KeyframeOf(map, keyframe).map_points.at(static_cast<std::size_t>(feature));
}
const PointFeature& FeatureOf(const Map& map, int keyframe, int feature) {
  return KeyframeOf(map, keyframe).features.at(static_cast<std::size_t>(feature));
}

// A point that loses an observation needs more than one view with depth to go on.
constexpr int kMinWeightLeft = 3;  // see ObservationWeight

/// The descriptor with the least median distance to all others of the point.
Descriptor CentralDescriptor(const Map& map, const MapPoint& point) {
  std::vector<const Descriptor*> seen;
  for (const auto& [keyframe, feature] : point.observations) {
    seen.push_back(&FeatureOf(map, keyframe, feature).descriptor);
  }
  int best_median = std::numeric_limits<int>::max();
  const Descriptor* best = seen.front();
  for (const Descriptor* candidate : seen) {
    std::vector<int> distances;
    distances.reserve(seen.size());
    for (const Descriptor* other : seen) {
      distances.push_back(DescriptorDistance(*candidate, *other));
    }
    const int median = LowerMedian(std::move(distances));
    if (median < best_median) best_median = median, best = candidate;
  }
  return *best;
}

/// Mean viewing direction, and the distances at which the pyramid's scales can match.
void UpdateView(const Map& map, MapPoint& point, const FeatureScale& scale) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [keyframe, feature] : point.observations) {
    const Pose T_wc = Inverse(KeyframeOf(map, keyframe).T_cw);
    const Eigen::Vector3d ray_w = point.p_w - T_wc.t;
    if (ray_w.norm() > 0) sum += ray_w.normalized();
  }
  if (sum.norm() > 0) point.view_w = sum.normalized();

  const auto first = point.observations.find(point.first_keyframe);
  const auto& [keyframe, feature] =
      first != point.observations.end() ? *first : *point.observations.begin();
  const double distance = (KeyframeOf(map, keyframe).T_cw * point.p_w).norm();
  point.max_distance_m = distance * scale.Scale(FeatureOf(map, keyframe, feature).octave);
  point.min_distance_m = point.max_distance_m / scale.Scale(scale.octaves - 1);
}

}  // namespace

int AddPoint(Map& map, const Eigen::Vector3d& p_w, int keyframe, int feature,
             const FeatureScale& scale) {
  Require(SlotOf(map, keyframe, feature) == kNone, "AddPoint: the feature has a point already");
  MapPoint point;
  point.id = static_cast<int>(map.points.size());
  point.p_w = p_w;
  point.first_keyframe = keyframe;
  map.points.push_back(point);
  AddObservation(map, point.id, keyframe, feature);
  UpdatePoint(map, point.id, scale);
  return point.id;
}

void AddObservation(Map& map, int point, int keyframe, int feature) {
  MapPoint& p = PointOf(map, point);
  int& slot = SlotOf(map, keyframe, feature);
  if (p.culled || slot != kNone || p.observations.count(keyframe) != 0) return;
  p.observations[keyframe] = feature;
  slot = point;
}

void RemoveObservation(Map& map, int point, int keyframe) {
  MapPoint& p = PointOf(map, point);
  const auto found = p.observations.find(keyframe);
  if (found == p.observations.end()) return;
  SlotOf(map, keyframe, found->second) = kNone;
  p.observations.erase(found);
  if (ObservationWeight(map, point) < kMinWeightLeft) CullPoint(map, point);
}

void CullPoint(Map& map, int point) {
  MapPoint& p = PointOf(map, point);
  for (const auto& [keyframe, feature] : p.observations) SlotOf(map, keyframe, feature) = kNone;
  p.observations.clear();
  p.culled = true;
}

void ReplacePoint(Map& map, int point, int into) {
  if (point == into) return;
  const std::map<int, int> observations = PointOf(map, point).observations;
  CullPoint(map, point);
  for (const auto& [keyframe, feature] : observations) {
    AddObservation(map, into, keyframe, feature);
  }
  PointOf(map, point).replaced_by = into;
  PointOf(map, into).visible_count += PointOf(map, point).visible_count;
  PointOf(map, into).found_count += PointOf(map, point).found_count;
}

int ObservationWeight(const Map& map, int point) {
  int weight = 0;
  for (const auto& [keyframe, feature] : PointOf(map, point).observations) {
    weight += FeatureOf(map, keyframe, feature).depth_m > 0 ? 2 : 1;
  }
  return weight;
}

void UpdatePoint(Map& map, int point, const FeatureScale& scale) {
  MapPoint& p = PointOf(map, point);
  if (p.culled || p.observations.empty()) return;
  p.descriptor = CentralDescriptor(map, p);
  UpdateView(map, p, scale);
}

int CullYoungPoints(Map& map, int keyframe, const PointCullingConfig& config) {
  int culled = 0;
  // Ids grow with the keyframes that made them, but for those that mapping made while tracking went on
  // to the next few: the young ones are near the end.
  constexpr int kMaxDisorder = 8;  // keyframes: more than ever wait for mapping
  for (int id = static_cast<int>(map.points.size()) - 1; id >= 0; --id) {
    const MapPoint& point = PointOf(map, id);
    const int age = keyframe - point.first_keyframe;
    if (age > config.trial_keyframes + kMaxDisorder) break;
    if (age > config.trial_keyframes || point.culled) continue;
    const bool seldom_found = point.found_count < config.min_found_ratio * point.visible_count;
    const bool unsupported = age >= 2 && ObservationWeight(map, id) < config.min_weight;
    if (!seldom_found && !unsupported) continue;
    CullPoint(map, id);
    ++culled;
  }
  return culled;
}

}  // namespace slam
