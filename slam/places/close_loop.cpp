#include "slam/places/close_loop.h"

#include <algorithm>
#include <set>
#include <utility>

#include "slam/base/index.h"
#include "slam/mapping/bundle/bundle_window.h"
#include "slam/model/map_queries.h"
#include "slam/places/carry_map.h"
#include "slam/places/pose_graph.h"

namespace slam {
namespace {

using Pair = std::pair<int, int>;  // ids of keyframes, the older first

/// Pairs that tie the map together: those that share much, each keyframe with the older one
/// that shares most with it, and neighbours in time where there is none.
std::set<Pair> Ties(const Map& map, int min_points) {
  std::set<Pair> ties;
  int previous = kNone;
  for (const Keyframe& keyframe : map.keyframes) {
    if (keyframe.culled) continue;
    int parent = kNone, most = 0;
    for (const auto& [other, shared] : keyframe.covisible) {
      if (other > keyframe.id) continue;
      if (shared >= min_points) ties.emplace(other, keyframe.id);
      if (shared > most) parent = other, most = shared;
    }
    if (parent == kNone) parent = previous;
    if (parent != kNone) ties.emplace(parent, keyframe.id);
    previous = keyframe.id;
  }
  return ties;
}

/// Moves the keyframe and its neighbours as one to where the loop puts the keyframe.
void MoveGroup(Map& map, const Loop& loop, const std::vector<int>& group) {
  const std::vector<Pose> before = KeyframePoses(map);
  const Pose T_wc_old = Inverse(before[Index(loop.keyframe)]);
  for (const int id : group) {
    map.keyframes[Index(id)].T_cw = Normalised(before[Index(id)] * T_wc_old * loop.T_cw);
  }
  CarryPoints(map, before);
}

/// The keyframe's features get the place's points; what they had is fused into them.
int TakePlacePoints(Map& map, const Loop& loop, const FeatureScale& scale) {
  int fused = 0;
  for (std::size_t f = 0; f < loop.map_points.size(); ++f) {
    const int known = CurrentPoint(map, loop.map_points[f]);
    const int own = map.keyframes[Index(loop.keyframe)].map_points[f];
    if (known == kNone || own == known) continue;
    if (own == kNone) {
      AddObservation(map, known, loop.keyframe, static_cast<int>(f));
    } else {
      ReplacePoint(map, own, known);
    }
    UpdatePoint(map, known, scale);
    ++fused;
  }
  return fused;
}

/// Spreads the error over the pose graph.
/// @param ties, before_loop  edges and poses before the loop was known
/// @param ties_now  edges with what the loop has tied together
void Spread(Map& map, const std::set<Pair>& ties, const std::vector<Pose>& before_loop,
            const std::set<Pair>& ties_now) {
  // Nodes: all keyframes, where the loop has put them so far.
  std::vector<int> ids;
  std::vector<int> position(map.keyframes.size(), kNone);
  std::vector<Pose> poses;
  for (const Keyframe& keyframe : map.keyframes) {
    if (keyframe.culled) continue;
    position[Index(keyframe.id)] = static_cast<int>(ids.size());
    ids.push_back(keyframe.id);
    poses.push_back(keyframe.T_cw);
  }
  // Edges: as it was before the loop, and as the loop says where that is new.
  std::vector<PoseEdge> edges;
  const auto tie = [&](const Pair& pair, const Pose& T_iw, const Pose& T_jw) {
    edges.push_back(
        {position[Index(pair.first)], position[Index(pair.second)], T_iw * Inverse(T_jw)});
  };
  for (const Pair& pair : ties) {
    tie(pair, before_loop[Index(pair.first)], before_loop[Index(pair.second)]);
  }
  for (const Pair& pair : ties_now) {
    if (ties.count(pair) != 0) continue;
    tie(pair, map.keyframes[Index(pair.first)].T_cw, map.keyframes[Index(pair.second)].T_cw);
  }
  if (!OptimisePoseGraph(poses, edges)) return;
  // Points move along with their keyframes.
  const std::vector<Pose> before = KeyframePoses(map);
  for (std::size_t i = 0; i < ids.size(); ++i) map.keyframes[Index(ids[i])].T_cw = poses[i];
  CarryPoints(map, before);
}

/// Moves, fuses and spreads the error: all but the adjustment of the whole map.
LoopReport DrawTogether(Map& map, const Loop& loop, const Camera& camera,
                        const FeatureScale& scale, const LocalMappingConfig& mapping,
                        const LoopClosingConfig& config) {
  LoopReport report;
  const std::vector<Pose> before = KeyframePoses(map);
  report.moved_m = (Inverse(loop.T_cw).t - Inverse(before[Index(loop.keyframe)]).t).norm();
  const std::set<Pair> ties = Ties(map, config.min_edge_points);
  std::vector<int> group{loop.keyframe};
  for (const auto& [other, shared] : map.keyframes[Index(loop.keyframe)].covisible) {
    if (other != 0) group.push_back(other);  // the world stays
  }

  // What the group sees there is what the place holds.
  MoveGroup(map, loop, group);
  report.fused = TakePlacePoints(map, loop, scale);
  UpdateCovisibility(map, loop.keyframe, mapping.keyframes);
  for (const int id : group) {
    report.fused += FusePoints(map, id, camera, scale, mapping.fusion);
    UpdateCovisibility(map, id, mapping.keyframes);
  }
  // The rest of the map shares the error.
  std::set<Pair> ties_now = Ties(map, config.min_edge_points);
  ties_now.emplace(std::min(loop.place, loop.keyframe), std::max(loop.place, loop.keyframe));
  Spread(map, ties, before, ties_now);
  CarryPlanes(map, before);
  return report;
}

/// Adjusts all keyframes, points and planes; what stays outside is carried along.
/// @returns whether that was usable
bool AdjustAll(Map& map, const Camera& camera, const FeatureScale& scale,
               LocalBundleConfig config, int iterations, const MapTurn& turn) {
  BundleWindow window;
  turn([&] { window = FullWindow(map, camera, scale, config); });
  config.first_iterations = config.last_iterations = iterations;
  if (!SolveWindow(window, config).usable) return false;
  turn([&] {
    const std::vector<Pose> before = KeyframePoses(map);
    CarryPlanes(map, before, MergeWindow(window, scale, map));
  });
  return true;
}

}  // namespace

LoopReport CloseLoop(Map& map, const Loop& loop, const Camera& camera,
                     const FeatureScale& scale, const LocalMappingConfig& mapping,
                     const LoopClosingConfig& config, const MapTurn& turn) {
  LoopReport report;
  turn([&] { report = DrawTogether(map, loop, camera, scale, mapping, config); });
  if (config.full_iterations > 0) {
    report.adjusted =
        AdjustAll(map, camera, scale, mapping.bundle, config.full_iterations, turn);
  }
  return report;
}

}  // namespace slam
