#include "slam/model/map_queries.h"

#include <algorithm>
#include <limits>
#include <map>

#include "slam/base/index.h"

namespace slam {

int CurrentPoint(const Map& map, int point) {
  while (point != kNone) {
    const MapPoint& p = map.points.at(Index(point));
    if (p.replaced_by == kNone) return p.culled ? kNone : point;
    point = p.replaced_by;
  }
  return kNone;
}

int CurrentPlane(const Map& map, int plane) {
  while (map.planes.At(plane).merged_into != kNone) plane = map.planes.At(plane).merged_into;
  return plane;
}

bool StepLiesBetween(const MapPlane& one, const MapPlane& other) {
  constexpr int kMinFrames = 2;  // one may be a fault of its frame
  const auto steps = one.stepped.find(other.id);
  if (steps == one.stepped.end() || steps->second < kMinFrames) return false;
  const auto together = one.covisible.find(other.id);
  return together == one.covisible.end() || 2 * steps->second > together->second;
}

std::optional<std::size_t> NearestVertex(const MapPlane& map_plane, const Eigen::Vector3d& p_w,
                                         double max_gap_m) {
  std::optional<std::size_t> nearest;
  double least_m = max_gap_m;
  for (std::size_t i = 0; i < map_plane.vertices_w.size(); ++i) {
    const double gap_m = (map_plane.vertices_w[i] - p_w).norm();
    if (!(gap_m < least_m)) continue;
    least_m = gap_m;
    nearest = i;
  }
  return nearest;
}

Pose KeyframePose(const Map& map, int keyframe) {
  Pose T_ck;  // identity: from the keyframe walked to, back to the one asked for
  const Keyframe* k = &map.keyframes.at(Index(keyframe));
  while (k->culled) {
    T_ck = T_ck * k->T_cp;
    k = &map.keyframes.at(Index(k->parent));
  }
  return T_ck * k->T_cw;
}

int NearestKeyframe(const Map& map, const Pose& T_cw) {
  int nearest = kNone;
  double least = std::numeric_limits<double>::infinity();
  for (const Keyframe& keyframe : map.keyframes) {
    if (keyframe.culled) continue;
    const double off = (Inverse(keyframe.T_cw).t - Inverse(T_cw).t).norm() +
                       RotationAngle(keyframe.T_cw, T_cw);
    if (off < least) nearest = keyframe.id, least = off;
  }
  return nearest;
}

std::vector<int> PointsSeenBy(const std::vector<int>& keyframes, const Map& map) {
  std::vector<int> points;
  for (const int keyframe : keyframes) {
    for (const int point : map.keyframes[Index(keyframe)].map_points) {
      if (point != kNone) points.push_back(point);
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

int KeyframesAfter(const Map& map, int frame_index) {
  const auto first = std::upper_bound(
      map.keyframes.begin(), map.keyframes.end(), frame_index,
      [](int index, const Keyframe& keyframe) { return index < keyframe.frame_index; });
  return static_cast<int>(map.keyframes.end() - first);
}

std::vector<MatchedPoint> MatchedPoints(const Frame& frame, const Map& map) {
  std::vector<MatchedPoint> matched;
  const std::size_t count = std::min(frame.features.size(), frame.map_points.size());
  for (std::size_t feature = 0; feature < count; ++feature) {
    const int point = frame.map_points[feature];
    if (point == kNone || point >= static_cast<int>(map.points.size())) continue;
    if (!map.points[Index(point)].culled) matched.push_back({feature, point});
  }
  return matched;
}

std::vector<int> MostCountedFirst(const std::map<int, int>& count_of_id) {
  std::vector<int> ids;
  ids.reserve(count_of_id.size());
  for (const auto& [id, count] : count_of_id) ids.push_back(id);
  std::stable_sort(ids.begin(), ids.end(),
                   [&](int a, int b) { return count_of_id.at(a) > count_of_id.at(b); });
  return ids;
}

std::vector<int> BestCovisible(const Map& map, int keyframe, int count) {
  std::vector<int> ids = MostCountedFirst(map.keyframes[Index(keyframe)].covisible);
  if (ids.size() > Index(std::max(count, 0))) ids.resize(Index(std::max(count, 0)));
  return ids;
}

}  // namespace slam
