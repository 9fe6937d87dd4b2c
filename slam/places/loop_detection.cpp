#include "slam/places/loop_detection.h"

#include <algorithm>
#include <set>

#include "slam/base/index.h"
#include "slam/model/map_queries.h"
#include "slam/pose/point_constraints.h"

namespace slam {
namespace {

/// The keyframe, its neighbours and theirs: that it sees them again is no loop.
std::vector<int> Surroundings(const Map& map, int keyframe) {
  std::set<int> near{keyframe};
  for (const auto& [other, shared] : map.keyframes[Index(keyframe)].covisible) {
    near.insert(other);
    for (const auto& [next, points] : map.keyframes[Index(other)].covisible) near.insert(next);
  }
  return {near.begin(), near.end()};
}

/// Lowest likeness of the keyframe to those that share points with it; 1 when none does.
double MinLikenessToNeighbours(const Map& map, const KeyframeIndex& index, int keyframe) {
  double lowest = 1.0;
  for (const auto& [other, shared] : map.keyframes[Index(keyframe)].covisible) {
    lowest = std::min(lowest, Likeness(index.Bag(keyframe), index.Bag(other)));
  }
  return lowest;
}

/// The keyframe as a frame that knows nothing of the map yet.
Frame AsLost(const Keyframe& keyframe) {
  Frame frame;
  frame.index = keyframe.frame_index;
  frame.timestamp_s = keyframe.timestamp_s;
  frame.features = keyframe.features;
  frame.map_points.assign(frame.features.size(), kNone);
  return frame;
}

/// Adds matches with the points around the place and finds the pose from all of them.
/// @returns inliers
int LookAround(Frame& frame, const Map& map, const std::vector<int>& own, const Camera& camera,
               const FeatureScale& scale, const PointSearchConfig& search,
               const LoopDetectionConfig& config) {
  constexpr int kKeyframes = 20;  // bounds the work, as tracking does
  const LocalMap local = GatherLocalMap(frame, map, kKeyframes);
  std::vector<bool> taken(frame.features.size());
  std::set<int> matched;
  for (std::size_t f = 0; f < taken.size(); ++f) {
    taken[f] = frame.map_points[f] != kNone;
    if (taken[f]) matched.insert(frame.map_points[f]);
  }
  // The place's other points, but not those that the keyframe sees already.
  std::vector<PointQuery> queries;
  for (const int id : local.points) {
    if (matched.count(id) != 0 || std::binary_search(own.begin(), own.end(), id)) continue;
    const PointQuery query = QueryOf(map.points[Index(id)], frame.T_cw, camera, scale,
                                     config.radius_factor, search.projection);
    if (query.point != kNone) queries.push_back(query);
  }
  const FeatureGrid grid(frame.features, camera);
  const std::vector<int> matches =
      MatchQueries(queries, frame.features, grid, taken, config.match);
  for (std::size_t f = 0; f < matches.size(); ++f) {
    if (matches[f] != kNone) frame.map_points[f] = queries[Index(matches[f])].point;
  }
  return OptimiseByPoints(frame, map, camera, scale, search.pose);
}

/// Whether so much can have drifted on the way from the place to the keyframe.
bool CanHaveDrifted(const Map& map, const Loop& loop, const LoopDetectionConfig& config) {
  double path_m = 0;
  for (int k = loop.place; k < loop.keyframe; ++k) {
    path_m += (Inverse(KeyframePose(map, k)).t - Inverse(KeyframePose(map, k + 1)).t).norm();
  }
  const Pose before_cw = map.keyframes[Index(loop.keyframe)].T_cw;
  const double moved_m = (Inverse(loop.T_cw).t - Inverse(before_cw).t).norm();
  return moved_m <= config.base_drift_m + config.drift_per_m * path_m &&
         RotationAngle(loop.T_cw, before_cw) <=
             config.base_drift_rad + config.drift_rad_per_m * path_m;
}

}  // namespace

std::optional<Loop> DetectLoop(const Map& map, const KeyframeIndex& index, int keyframe,
                               const Camera& camera, const FeatureScale& scale,
                               const PointSearchConfig& search,
                               const LoopDetectionConfig& config) {
  const Keyframe& now = map.keyframes[Index(keyframe)];
  const double min_likeness =
      config.min_likeness_ratio * MinLikenessToNeighbours(map, index, keyframe);
  const std::vector<int> own = PointsSeenBy({keyframe}, map);

  // The pose of the keyframe from each older place that looks like it.
  std::vector<Loop> found;
  const std::vector<LikeKeyframe> like =
      index.Like(index.Bag(keyframe), map, Surroundings(map, keyframe), search.place.likeness);
  int asked = 0;
  for (const LikeKeyframe& candidate : like) {
    if (candidate.likeness < min_likeness || candidate.keyframe > keyframe) continue;
    if (++asked > search.place.max_keyframes) break;
    Frame frame = AsLost(now);
    const auto seen =
        FindPose(map.keyframes[Index(candidate.keyframe)], frame, map, camera, scale, search);
    if (!seen) continue;
    frame.T_cw = seen->T_cw;
    frame.map_points = seen->map_points;
    const int inliers = LookAround(frame, map, own, camera, scale, search, config);
    if (inliers < config.min_inliers) continue;
    found.push_back({keyframe, candidate.keyframe, frame.T_cw, frame.map_points, inliers});
  }
  const Loop* best = ClearlyBest(found, search.place);
  if (best == nullptr || !CanHaveDrifted(map, *best, config)) return std::nullopt;
  return *best;
}

}  // namespace slam
