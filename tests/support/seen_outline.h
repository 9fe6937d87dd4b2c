#pragma once

#include "slam/base/index.h"
#include "tests/support/point_world.h"
#include "tests/support/seen_landmark.h"

namespace slam {

constexpr double kEdgeSigma_rad = 0.01, kEdgeSigma_m = 0.004;

/// The plane at a right angle to the landmark through one of its sides, facing outwards.
inline Plane SideAt(const MapPlane& landmark, std::size_t side) {
  const auto& corners_w = landmark.vertices_w;
  const Eigen::Vector3d edge_w = (corners_w[side] + corners_w[(side + 1) % kFaceCorners]) / 2;
  const Eigen::Vector3d n = (edge_w - (corners_w[0] + corners_w[2]) / 2).normalized();
  return {n, -n.dot(edge_w)};
}

/// Makes a landmark of AddSeenLandmark a face, 0.4 m by 0.3 m about its middle, whose corners and
/// edges all its keyframes have seen without error.
inline void AddSeenOutline(Map& map, int landmark) {
  MapPlane& face = map.planes.At(landmark);
  const Eigen::Matrix<double, 3, 2> along = TangentBasis(face.pi_w.n);
  face.vertices_w.clear();
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(-0.2, -0.15), Eigen::Vector2d(0.2, -0.15),
                                    Eigen::Vector2d(0.2, 0.15), Eigen::Vector2d(-0.2, 0.15)})
    face.vertices_w.push_back(face.centroid_w + along * at);
  for (std::size_t i = 0; i < kFaceCorners; ++i) {
    const Plane side_w = SideAt(face, i);
    const Eigen::Vector3d edge_w = ProjectOnto(side_w, face.centroid_w);
    SupposedPlane& supposed = face.supposed.emplace_back();
    supposed.pi_w = side_w;
    AddObservation(supposed.estimate, side_w, edge_w, kEdgeSigma_rad, kEdgeSigma_m, 1.0);
    for (Keyframe& keyframe : map.keyframes) {
      for (KeyframePlane& seen : keyframe.planes) {
        if (seen.map_plane != landmark) continue;
        seen.vertices_c.push_back(
            {keyframe.T_cw * face.vertices_w[i], false, Eigen::Matrix3d::Zero()});
        seen.edges.push_back({Transform(keyframe.T_cw, side_w), keyframe.T_cw * edge_w,
                              kEdgeSigma_rad, kEdgeSigma_m});
      }
    }
  }
}

/// Lays the first `count` points of the world onto a landmark, as far as they then stay in front of
/// all cameras that have seen them. @returns how many lie on it
inline int LayPointsOn(int landmark, int count, PointWorld& world) {
  MapPlane& face = world.map.planes.At(landmark);
  for (MapPoint& point : world.map.points) {
    if (point.id >= count) break;
    const Eigen::Vector3d p_w = ProjectOnto(face.pi_w, point.p_w);
    bool in_front = true;
    for (const auto& [seen_by, feature] : point.observations)
      in_front = in_front && (world.map.keyframes[Index(seen_by)].T_cw * p_w).z() > 0.3;
    if (!in_front) continue;
    point.p_w = p_w;
    face.map_points.insert(point.id);
    for (const auto& [seen_by, feature] : point.observations) {
      Keyframe& keyframe = world.map.keyframes[Index(seen_by)];
      PointFeature& seen = keyframe.features[Index(feature)];
      seen =
          FeatureOfPoint(p_w, keyframe.T_cw, world.camera, seen.descriptor, seen.depth_m > 0);
    }
  }
  return static_cast<int>(face.map_points.size());
}

}  // namespace slam
