#include "slam/model/map_queries.h"

#include <algorithm>
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

Pose KeyframePose(const Map& map, int keyframe) {
  Pose T_ck;  // identity: from the keyframe walked to, back to the one asked for
  const Keyframe* k = &map.keyframes.at(Index(keyframe));
  while (k->culled) {
    T_ck = T_ck * k->T_cp;
    k = &map.keyframes.at(Index(k->parent));
  }
  return T_ck * k->T_cw;
}

std::vector<int> BestCovisible(const Map& map, int keyframe, int count) {
  const std::map<int, int>& covisible = map.keyframes[Index(keyframe)].covisible;
  std::vector<int> ids;
  for (const auto& [other, shared] : covisible) ids.push_back(other);
  std::stable_sort(ids.begin(), ids.end(),
                   [&](int a, int b) { return covisible.at(a) > covisible.at(b); });
  if (ids.size() > Index(std::max(count, 0))) ids.resize(Index(std::max(count, 0)));
  return ids;
}

}  // namespace slam
