#include "slam/tracking/map_covariance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/base/index.h"
#include "slam/mapping/keyframe_planes.h"
#include "slam/model/map_queries.h"
#include "slam/pose/pose_error.h"

namespace slam {

int KeyframeByPlanes(const Frame& frame, const Map& map) {
  std::vector<const MapPlane*> shown;
  for (const PlaneMatch& match : frame.plane_matches) {
    if (match.ShowsLandmark())
      shown.push_back(&map.planes.At(CurrentPlane(map, match.map_plane)));
  }
  int best = kNone;
  std::ptrdiff_t most = 0;
  for (const Keyframe& keyframe : map.keyframes) {
    if (keyframe.culled) continue;
    const auto shared = std::count_if(
        keyframe.planes.begin(), keyframe.planes.end(), [&](const KeyframePlane& plane) {
          const MapPlane* landmark = LandmarkOf(map, plane);
          return landmark != nullptr &&
                 std::find(shown.begin(), shown.end(), landmark) != shown.end();
        });
    if (shared > most) best = keyframe.id, most = shared;
  }
  return best;
}

Matrix6d MapCovarianceAt(const Pose& T_cw, const Map& map, int keyframe) {
  const Matrix6d carry = Adjoint(T_cw * Inverse(KeyframePose(map, keyframe)));
  return carry * map.keyframes[Index(keyframe)].covariance * carry.transpose();
}

Matrix6d MapCovarianceByPlanes(const Frame& frame, const Map& map,
                               const std::vector<PlaneConstraint>& planes) {
  Matrix6d covariance = Matrix6d::Zero();
  if (const int keyframe = KeyframeByPlanes(frame, map); keyframe != kNone)
    covariance = MapCovarianceAt(frame.T_cw, map, keyframe);
  // What the planes may lie off beyond that: along each step of the camera the mean, as they weigh in it.
  Eigen::Matrix3d weight = Eigen::Matrix3d::Zero(), weighted = weight;
  for (const PlaneConstraint& plane : planes) {
    const double beyond_m2 =
        std::max(0.0, plane.world_variance_m2 -
                          VarianceAlong(covariance, plane.pi_c.n, plane.centroid_c));
    const Eigen::Matrix3d along =
        plane.pi_c.n * plane.pi_c.n.transpose() / (plane.offset_sigma_m * plane.offset_sigma_m);
    weight += along;
    weighted += beyond_m2 * along;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(weight);
  constexpr double kNothing = 1e-9;  // of the best-known step
  Eigen::Vector3d scale = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (axes.eigenvalues()[i] > kNothing * axes.eigenvalues()[2])
      scale[i] = 1.0 / std::sqrt(axes.eigenvalues()[i]);
  }
  const Eigen::Matrix3d root =
      axes.eigenvectors() * scale.asDiagonal() * axes.eigenvectors().transpose();
  covariance.topLeftCorner<3, 3>() += root * weighted * root;
  return covariance;
}

}  // namespace slam
