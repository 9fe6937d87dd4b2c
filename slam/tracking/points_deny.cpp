#include "slam/tracking/points_deny.h"

#include <algorithm>
#include <set>

#include "slam/base/index.h"
#include "slam/model/map_queries.h"

namespace slam {

bool PointsDeny(const Frame& frame, const Map& map, const Pose& T_cw, int keyframe,
                const Camera& camera, const FeatureScale& scale,
                const PointProjectionConfig& projection, const PointMatchConfig& match) {
  constexpr int kNeighbours = 5;
  constexpr double kRadiusFactor = 5.0;  // planes tell a place to a centimetre or two
  constexpr int kMinInView = 50;         // below, chance decides
  constexpr double kMinShare = 0.02;     // the right place: 0.05 and more; another: 0.001
  // The points of the keyframe and of those that see the same, where a feature could show them.
  std::vector<int> keyframes = BestCovisible(map, keyframe, kNeighbours);
  keyframes.push_back(keyframe);
  std::set<int> points;
  for (const int id : keyframes) {
    for (const int point : map.keyframes[Index(id)].map_points) {
      if (CurrentPoint(map, point) != kNone) points.insert(CurrentPoint(map, point));
    }
  }
  const FeatureGrid grid(frame.features, camera);
  std::vector<PointQuery> queries;
  for (const int id : points) {
    PointQuery query =
        QueryOf(map.points[Index(id)], T_cw, camera, scale, kRadiusFactor, projection);
    if (query.point == kNone ||
        grid.Near(query.u_px, query.radius_px, query.min_octave, query.max_octave).empty()) {
      continue;
    }
    queries.push_back(query);
  }
  const std::vector<int> matches = MatchQueries(queries, frame.features, grid, {}, match);
  const auto alike = static_cast<double>(matches.size()) -
                     static_cast<double>(std::count(matches.begin(), matches.end(), kNone));
  const auto met = static_cast<double>(std::min(queries.size(), frame.features.size()));
  return met >= kMinInView && alike < kMinShare * met;
}

}  // namespace slam
