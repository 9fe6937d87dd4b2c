#include "slam/places/carry_map.h"

#include <algorithm>
#include <cstdlib>

#include "slam/base/index.h"
#include "slam/mapping/plane_motion.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

/// T_new_old of a keyframe: what was at x in the old world is at T x in the new one.
Pose Carriage(const Map& map, const std::vector<Pose>& before, int keyframe) {
  return Normalised(Inverse(KeyframePose(map, keyframe)) * before[Index(keyframe)]);
}

/// Id of the keyframe nearest in time to a frame; the first at a tie.
int NearestInTime(const Map& map, int frame_index) {
  int nearest = 0;
  for (const Keyframe& keyframe : map.keyframes) {
    if (std::abs(keyframe.frame_index - frame_index) <
        std::abs(map.keyframes[Index(nearest)].frame_index - frame_index)) {
      nearest = keyframe.id;
    }
  }
  return nearest;
}

}  // namespace

std::vector<Pose> KeyframePoses(const Map& map) {
  std::vector<Pose> poses;
  for (const Keyframe& keyframe : map.keyframes) {
    poses.push_back(KeyframePose(map, keyframe.id));
  }
  return poses;
}

void CarryPoints(Map& map, const std::vector<Pose>& before) {
  std::vector<Pose> carriages;
  for (const Keyframe& keyframe : map.keyframes) {
    carriages.push_back(Carriage(map, before, keyframe.id));
  }
  for (MapPoint& point : map.points) {
    if (!point.culled) point.p_w = carriages[Index(point.first_keyframe)] * point.p_w;
  }
}

Pose CarriageSince(const Map& map, const std::vector<Pose>& before, int first_frame) {
  return Carriage(map, before, NearestInTime(map, first_frame));
}

void CarryPlanes(Map& map, const std::vector<Pose>& before, const std::set<int>& placed) {
  if (map.keyframes.empty()) return;
  for (MapPlane& plane : map.planes) {
    if (placed.count(plane.id) != 0) continue;
    const bool candidate = plane.status == LandmarkStatus::kCandidate;
    const Pose T_new_old = candidate ? Carriage(map, before, map.keyframes.back().id)
                                     : CarriageSince(map, before, plane.first_frame);
    MovePlane(plane, T_new_old);
    if (candidate) continue;
    for (SupposedPlane& supposed : plane.supposed)
      MoveSupposed(supposed,
                   CarriageSince(map, before, supposed.first_frame) * Inverse(T_new_old));
  }
}

}  // namespace slam
