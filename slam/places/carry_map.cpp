#include "slam/places/carry_map.h"

#include <algorithm>
#include <cstdlib>

#include "slam/base/index.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

/// T_new_old of a keyframe: what was at x in the old world is at T x in the new one.
Pose Carriage(const Map& map, const std::vector<Pose>& before, int keyframe) {
  return Normalised(Inverse(KeyframePose(map, keyframe)) * before[Index(keyframe)]);
}

void MoveAll(std::vector<Eigen::Vector3d>& points_w, const Pose& T_new_old) {
  for (Eigen::Vector3d& p_w : points_w) p_w = T_new_old * p_w;
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

void MovePlane(MapPlane& plane, const Pose& T_new_old) {
  // Transform takes planes as T_cw does: from the world into the frame on its left.
  plane.pi_w = Transform(T_new_old, plane.pi_w);
  plane.centroid_w = T_new_old * plane.centroid_w;
  plane.estimate.origin_w = T_new_old * plane.estimate.origin_w;
  plane.estimate.normal_w = (T_new_old.R * plane.estimate.normal_w).normalized();
  plane.estimate.axes = T_new_old.R * plane.estimate.axes;
  MoveAll(plane.points_w, T_new_old);
  MoveAll(plane.edge_points_w, T_new_old);
  MoveAll(plane.vertices_w, T_new_old);
  MoveAll(plane.hull_w, T_new_old);
  for (PlanePart& part : plane.parts) {
    MovePlane(part.surface, T_new_old);
    MovePlane(part.rest, T_new_old);
  }
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

void CarryPlanes(Map& map, const std::vector<Pose>& before) {
  if (map.keyframes.empty()) return;
  for (MapPlane& plane : map.planes) {
    const bool candidate = plane.status == LandmarkStatus::kCandidate;
    MovePlane(plane, Carriage(map, before,
                              candidate ? map.keyframes.back().id
                                        : NearestInTime(map, plane.first_frame)));
  }
}

}  // namespace slam
