#include "slam/model/local_map.h"

#include <map>
#include <set>

#include "slam/base/index.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

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
  return MostCountedFirst(votes);
}

}  // namespace

LocalMap GatherLocalMap(const Frame& frame, const Map& map, int max_keyframes) {
  constexpr int kNeighbours = 5;  // balances what may come into view against work
  LocalMap local;
  // Keyframes that see the frame's points, and the nearest neighbours of each.
  std::vector<int> wanted = Voted(frame, map);
  if (!wanted.empty()) local.reference = wanted.front();
  const std::size_t voted = wanted.size();
  for (std::size_t i = 0; i < voted && i < Index(max_keyframes); ++i) {
    const std::vector<int> best = BestCovisible(map, wanted[i], kNeighbours);
    wanted.insert(wanted.end(), best.begin(), best.end());
  }
  // Each once, in this order, up to the bound.
  std::set<int> seen;
  for (const int keyframe : wanted) {
    if (local.keyframes.size() >= Index(max_keyframes)) break;
    if (seen.insert(keyframe).second) local.keyframes.push_back(keyframe);
  }
  local.points = PointsSeenBy(local.keyframes, map);
  return local;
}

}  // namespace slam
