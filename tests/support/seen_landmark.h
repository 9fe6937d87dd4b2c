#pragma once

#include <cmath>

#include "slam/mapping/keyframe_planes.h"
#include "slam/mapping/plane_motion.h"
#include "slam/model/map.h"
#include "tests/support/map_surfaces.h"

namespace slam {

/// What a keyframe measures of a plane without error, about x_w.
inline KeyframePlane ExactKeyframePlane(const Keyframe& keyframe, int map_plane,
                                        const Plane& pi_w, const Eigen::Vector3d& x_w) {
  KeyframePlane seen;
  seen.map_plane = map_plane;
  seen.pi_c = Transform(keyframe.T_cw, pi_w);
  seen.centroid_c = keyframe.T_cw * ProjectOnto(pi_w, x_w);
  return seen;
}

/// Puts a landmark into the map that all its keyframes have seen without error, each a patch of
/// its own up to 0.2 m about x_w. @returns its id
inline int AddSeenLandmark(Map& map, const Plane& pi_w, const Eigen::Vector3d& x_w) {
  MapPlane landmark;
  landmark.pi_w = pi_w;
  landmark.centroid_w = ProjectOnto(pi_w, x_w);
  landmark.points_w = landmark.hull_w = landmark.vertices_w = {landmark.centroid_w};
  AddObservation(landmark.estimate, pi_w, landmark.centroid_w, 0.01, 0.005, 1.0);
  const int id = AddLandmark(map, landmark);
  for (Keyframe& keyframe : map.keyframes) {
    const double a = 2.4 * keyframe.id;  // spreads them all around
    const Eigen::Vector3d seen_w = x_w + 0.2 * Eigen::Vector3d(std::cos(a), std::sin(a), 0);
    keyframe.planes.push_back(ExactKeyframePlane(keyframe, id, pi_w, seen_w));
  }
  return id;
}

/// Moves the landmarks to where their keyframes, as these stand, have seen them.
inline void PlaceAsSeen(Map& map) {
  for (MapPlane& landmark : map.planes) {
    PlaneEstimate seen_w;
    for (const Keyframe& keyframe : map.keyframes) {
      const Pose T_wc = Inverse(keyframe.T_cw);
      for (const KeyframePlane& seen : keyframe.planes) {
        if (LandmarkOf(map, seen) != &landmark) continue;
        AddObservation(seen_w, Transform(T_wc, seen.pi_c), T_wc * seen.centroid_c,
                       seen.angle_sigma_rad, seen.offset_sigma_m, 1.0);
      }
    }
    if (seen_w.empty()) continue;
    MovePlane(landmark, MotionBetween(landmark.pi_w, seen_w.Mean(), landmark.centroid_w));
  }
}

/// A floor, a wall and another wall, none parallel to another.
inline std::vector<Plane> ThreePlanes() {
  return {{Eigen::Vector3d(0.1, -1, -0.2).normalized(), 1.1},
          {Eigen::Vector3d(0.2, 0.1, -1).normalized(), 2.6},
          {Eigen::Vector3d(-1, 0.1, -0.3).normalized(), 1.4}};
}

/// Landmarks on these planes, about 2 m before the first keyframe.
inline void AddSeenLandmarks(Map& map, const std::vector<Plane>& planes_w) {
  for (const Plane& pi_w : planes_w) AddSeenLandmark(map, pi_w, {0, 0, 2});
}

}  // namespace slam
