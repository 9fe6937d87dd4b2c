#include "slam/localise/local_map.h"

#include <algorithm>
#include <map>
#include <set>

#include "slam/mapping/keyframes.h"
#include "slam/mapping/map_points.h"

namespace slam {
namespace {

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

/// Keyframes by the number of the frame's points they see, most first.
std::vector<int> Voted(const Frame& frame, const Map& map) {
  std::map<int, int> votes;
  for (const int match : frame.map_points) {
    const int id = CurrentPoint(map, match);
    if (id == kNone) continue;
    for (const auto& [keyframe, feature] : map.points[Index(id)].observations) {
      ++votes[keyframe];
    }
  }
  std::vector<int> keyframes;
  for (const auto& [keyframe, count] : votes) keyframes.push_back(keyframe);
  std::stable_sort(keyframes.begin(), keyframes.end(),
                   [&](int a, int b) { return votes.at(a) > votes.at(b); });
  return keyframes;
}

}  // namespace

LocalMap GatherLocalMap(const Frame& frame, const Map& map, int max_keyframes) {
  constexpr int kNeighbours = 5;
  LocalMap local;
  std::vector<int> wanted = Voted(frame, map);
  if (!wanted.empty()) local.reference = wanted.front();
  const std::size_t voted = wanted.size();
  for (std::size_t i = 0; i < voted && i < Index(max_keyframes); ++i) {
    const std::vector<int> best = BestCovisible(map, wanted[i], kNeighbours);
    wanted.insert(wanted.end(), best.begin(), best.end());
  }
  std::set<int> seen;
  for (const int keyframe : wanted) {
    if (local.keyframes.size() >= Index(max_keyframes)) break;
    if (seen.insert(keyframe).second) local.keyframes.push_back(keyframe);
  }
  for (const int keyframe : local.keyframes) {
    for (const int point : map.keyframes[Index(keyframe)].map_points) {
      if (point != kNone) local.points.push_back(point);
    }
  }
  std::sort(local.points.begin(), local.points.end());
  local.points.erase(std::unique(local.points.begin(), local.points.end()), local.points.end());
  return local;
}

PointQuery QueryOf(const MapPoint& point, const Pose& T_cw, const Camera& camera,
                   double radius_factor, const PointProjectionConfig& config) {
  PointQuery query;
  const Eigen::Vector3d p_c = T_cw * point.p_w;
  if (!(p_c.z() > 0)) return query;
  const double distance = p_c.norm();
  if (!(distance * config.range_margin >= point.min_distance_m &&
        distance <= config.range_margin * point.max_distance_m)) {
    return query;
  }
  const Eigen::Vector2d u_px = camera.Project(p_c);
  if (!camera.ImageBox().Contains(u_px)) return query;
  const double cosine = (T_cw.R * point.view_w).dot(p_c) / distance;
  if (!(cosine >= config.min_view_cosine)) return query;

  const int octave = config.scales.PredictOctave(distance, point.max_distance_m);
  const double radius =
      cosine >= config.straight_view_cosine ? config.straight_radius_px : config.radius_px;
  query.point = point.id;
  query.u_px = u_px;
  query.right_u_px = u_px.x() - config.bf_px_m / p_c.z();
  query.radius_px = radius * radius_factor * config.scales.Scale(octave);
  query.min_octave = octave - 1;
  query.max_octave = octave + 1;
  query.descriptor = point.descriptor;
  return query;
}

}  // namespace slam
