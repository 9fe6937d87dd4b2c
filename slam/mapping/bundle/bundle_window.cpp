#include "slam/mapping/bundle/bundle_window.h"

#include <algorithm>
#include <set>

#include "slam/base/index.h"
#include "slam/mapping/bundle/bundle_planes.h"
#include "slam/mapping/keyframes.h"
#include "slam/mapping/map_points.h"
#include "slam/model/map_queries.h"
#include "slam/pose/point_constraints.h"

namespace slam {
namespace {

/// Keyframes outside that see the most of the points, at most `count` of them, ascending.
std::vector<int> OutsideViewers(const Map& map, const std::vector<int>& points,
                                const std::set<int>& inside, int count) {
  std::map<int, int> seen;
  for (const int point : points) {
    for (const auto& [keyframe, feature] : map.points[Index(point)].observations) {
      if (inside.count(keyframe) == 0) ++seen[keyframe];
    }
  }
  std::vector<int> outside = MostCountedFirst(seen);
  if (outside.size() > Index(count)) outside.resize(Index(count));
  std::sort(outside.begin(), outside.end());
  return outside;
}

/// Blocks and observations of the window's keyframes and points.
void FillWindow(const Map& map, const Camera& camera, const FeatureScale& scale,
                const LocalBundleConfig& config, BundleWindow& window) {
  std::map<int, std::size_t> pose_at;
  for (const int id : window.keyframes) {
    pose_at[id] = window.poses.size();
    window.poses.push_back(BlockOf(map.keyframes[Index(id)].T_cw));
  }
  for (const int id : window.points) {
    const MapPoint& point = map.points[Index(id)];
    for (const auto& [seen_by, feature] : point.observations) {
      const auto at = pose_at.find(seen_by);
      if (at == pose_at.end()) continue;
      const PointFeature& seen_as = map.keyframes[Index(seen_by)].features[Index(feature)];
      window.observations.push_back(
          {seen_by, id, at->second, window.positions.size(), seen_as.depth_m > 0, true,
           std::make_unique<BundleTerm>(ConstraintOf(seen_as, point.p_w, scale), camera),
           nullptr});
    }
    window.positions.push_back({point.p_w.x(), point.p_w.y(), point.p_w.z()});
  }
  if (config.use_planes) AddPlanes(map, pose_at, config, window);
  window.map_keyframes = map.keyframes.size();
  window.map_points = map.points.size();
}

/// Keyframes and points that came to the map after the window was taken move as its newest
/// keyframe does: they were placed by the map as it was.
void CarryTheNewer(const BundleWindow& window, Map& map) {
  if (window.map_keyframes == map.keyframes.size()) return;
  // The motion of the newest keyframe of the window, in the world.
  const auto newest =
      std::max_element(window.keyframes.begin(),
                       window.keyframes.begin() + static_cast<long>(window.free_count));
  const Pose T_new_w =
      PoseOf(window.poses[static_cast<std::size_t>(newest - window.keyframes.begin())].data());
  const Pose T_new_old = Normalised(Inverse(T_new_w) * map.keyframes[Index(*newest)].T_cw);
  for (std::size_t k = window.map_keyframes; k < map.keyframes.size(); ++k) {
    map.keyframes[k].T_cw = Normalised(map.keyframes[k].T_cw * Inverse(T_new_old));
  }
  for (std::size_t p = window.map_points; p < map.points.size(); ++p) {
    map.points[p].p_w = T_new_old * map.points[p].p_w;
  }
}

}  // namespace

BundleWindow FullWindow(const Map& map, const Camera& camera, const FeatureScale& scale,
                        const LocalBundleConfig& config) {
  BundleWindow window;
  if (map.keyframes.empty()) return window;
  std::vector<int> fixed{0};
  for (const Keyframe& keyframe : map.keyframes) {
    if (keyframe.culled || keyframe.id == 0) continue;
    (keyframe.by_points ? window.keyframes : fixed).push_back(keyframe.id);
  }
  window.free_count = window.keyframes.size();
  window.keyframes.insert(window.keyframes.end(), fixed.begin(), fixed.end());
  window.points = PointsSeenBy(window.keyframes, map);
  FillWindow(map, camera, scale, config, window);
  return window;
}

BundleWindow LocalWindow(const Map& map, int keyframe, const Camera& camera,
                         const FeatureScale& scale, const LocalBundleConfig& config) {
  // The keyframes that move, the points that they see, and who else sees these.
  std::vector<int> inside = BestCovisible(map, keyframe, config.max_keyframes - 1);
  inside.push_back(keyframe);
  std::sort(inside.begin(), inside.end());

  // Where planes hold a keyframe, its few points must not move it.
  inside.erase(std::remove_if(inside.begin(), inside.end(),
                              [&](int id) { return !map.keyframes[Index(id)].by_points; }),
               inside.end());
  BundleWindow window;
  if (inside.empty()) return window;
  window.points = PointsSeenBy(inside, map);
  std::vector<int> fixed = OutsideViewers(map, window.points, {inside.begin(), inside.end()},
                                          config.max_fixed_keyframes);
  // The first keyframe is the world; where no other sees the points, the oldest holds the
  // gauge.
  if (inside.front() == 0 || fixed.empty()) {
    fixed.push_back(inside.front());
    inside.erase(inside.begin());
  }
  window.free_count = inside.size();
  window.keyframes = inside;
  window.keyframes.insert(window.keyframes.end(), fixed.begin(), fixed.end());
  FillWindow(map, camera, scale, config, window);
  return window;
}

std::set<int> MergeWindow(const BundleWindow& window, const FeatureScale& scale, Map& map) {
  CarryTheNewer(window, map);
  const std::set<int> placed = MergePlanes(window, map);
  for (std::size_t i = 0; i < window.free_count; ++i) {
    map.keyframes[Index(window.keyframes[i])].T_cw = PoseOf(window.poses[i].data());
  }
  for (std::size_t i = 0; i < window.points.size(); ++i) {
    const auto& p = window.positions[i];
    map.points[Index(window.points[i])].p_w = {p[0], p[1], p[2]};
  }
  for (const BundleWindow::Observation& o : window.observations) {
    if (!o.inlier) RemoveObservation(map, o.point, o.keyframe);
  }
  for (const int id : window.points) UpdatePoint(map, id, scale);
  return placed;
}

}  // namespace slam
