#include "slam/mapping/point_triangulation.h"

#include <Eigen/Geometry>
#include <cmath>

#include "slam/base/chi_square.h"
#include "slam/base/index.h"
#include "slam/features/match_features.h"
#include "slam/features/point_projection.h"
#include "slam/geometry/plane.h"
#include "slam/mapping/keyframes.h"
#include "slam/mapping/map_points.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

Eigen::Vector3d Ray(const Camera& camera, const Eigen::Vector2d& u_px) {
  return camera.Backproject(u_px, 1.0);
}

/// F of the pixels: u_2^T F u_1 = 0 (homogeneous).
Eigen::Matrix3d Fundamental(const Pose& T_1w, const Pose& T_2w, const Camera& camera) {
  const Pose T_21 = T_2w * Inverse(T_1w);
  Eigen::Matrix3d K_inv = Eigen::Matrix3d::Identity();
  K_inv(0, 0) = 1.0 / camera.fx, K_inv(0, 2) = -camera.cx / camera.fx;
  K_inv(1, 1) = 1.0 / camera.fy, K_inv(1, 2) = -camera.cy / camera.fy;
  return K_inv.transpose() * Hat(T_21.t) * T_21.R * K_inv;
}

/// Squared distance of a pixel from a line (a, b, c).
double Distance2(const Eigen::Vector3d& line, const Eigen::Vector2d& u_px) {
  const double d = line.dot(u_px.homogeneous());
  return d * d / line.head<2>().squaredNorm();
}

/// The point projects onto the feature, and at its depth where it has one.
bool AgreesInView(const Eigen::Vector3d& p_w, const Pose& T_cw, const PointFeature& feature,
                  const Camera& camera, const FeatureScale& scale) {
  const Eigen::Vector3d p_c = T_cw * p_w;
  return p_c.z() > 0 && AgreesWith(feature, p_c, camera, scale);
}

/// Feature of `second` without a point that fits best to one of `first`; kNone when none does.
int EpipolarMatch(const PointFeature& feature, const Eigen::Vector3d& line,
                  const Keyframe& second, const FeatureScale& scale,
                  const TriangulationConfig& config) {
  constexpr int kNoMatch = 8 * static_cast<int>(sizeof(Descriptor)) + 1;  // bits
  int best = kNone, best_distance = kNoMatch, second_distance = kNoMatch;
  for (int j = 0; j < static_cast<int>(second.features.size()); ++j) {
    if (second.map_points[Index(j)] != kNone) continue;
    const PointFeature& other = second.features[Index(j)];
    const double gate = kChi2Of1At95 * scale.Variance(other.octave);
    if (!(Distance2(line, other.u_px) <= gate)) continue;
    const int distance = DescriptorDistance(feature.descriptor, other.descriptor);
    if (distance < best_distance) {
      second_distance = best_distance;
      best = j, best_distance = distance;
    } else if (distance < second_distance) {
      second_distance = distance;
    }
  }
  const bool clear = best_distance <= config.max_distance &&
                     best_distance <= config.max_ratio * second_distance;
  return clear ? best : kNone;
}

/// Makes the points of one pair of keyframes; returns how many.
int TriangulatePair(Map& map, int first, int second, const Camera& camera,
                    const FeatureScale& scale, const TriangulationConfig& config) {
  const Pose T_1w = map.keyframes[Index(first)].T_cw, T_2w = map.keyframes[Index(second)].T_cw;
  const Eigen::Matrix3d F = Fundamental(T_1w, T_2w, camera);
  int made = 0;
  for (int i = 0; i < static_cast<int>(map.keyframes[Index(first)].features.size()); ++i) {
    if (map.keyframes[Index(first)].map_points[Index(i)] != kNone) continue;
    const PointFeature& feature = map.keyframes[Index(first)].features[Index(i)];
    const Eigen::Vector3d line = F * feature.u_px.homogeneous();
    const int j = EpipolarMatch(feature, line, map.keyframes[Index(second)], scale, config);
    if (j == kNone) continue;
    const PointFeature& other = map.keyframes[Index(second)].features[Index(j)];
    const auto p_w =
        Triangulate(feature.u_px, T_1w, other.u_px, T_2w, camera, config.min_parallax_rad);
    if (!p_w || !AgreesInView(*p_w, T_1w, feature, camera, scale) ||
        !AgreesInView(*p_w, T_2w, other, camera, scale)) {
      continue;
    }
    const int point = AddPoint(map, *p_w, first, i, scale);
    AddObservation(map, point, second, j);
    UpdatePoint(map, point, scale);
    ++made;
  }
  return made;
}

}  // namespace

std::optional<Eigen::Vector3d> Triangulate(const Eigen::Vector2d& u_1_px, const Pose& T_1w,
                                           const Eigen::Vector2d& u_2_px, const Pose& T_2w,
                                           const Camera& camera, double min_parallax_rad) {
  const Pose T_w1 = Inverse(T_1w), T_w2 = Inverse(T_2w);
  const Eigen::Vector3d a = (T_w1.R * Ray(camera, u_1_px)).normalized();
  const Eigen::Vector3d b = (T_w2.R * Ray(camera, u_2_px)).normalized();
  if (!(Angle(a, b) >= min_parallax_rad)) return std::nullopt;
  // Feet of the common perpendicular of c_1 + s a and c_2 + t b.
  const Eigen::Vector3d between = T_w2.t - T_w1.t;
  const double ab = a.dot(b), scale = 1.0 - ab * ab;
  const double s = (between.dot(a) - ab * between.dot(b)) / scale;
  const double t = (ab * between.dot(a) - between.dot(b)) / scale;
  if (!(s > 0 && t > 0)) return std::nullopt;
  return 0.5 * (T_w1.t + s * a + T_w2.t + t * b);
}

int TriangulatePoints(Map& map, int keyframe, const Camera& camera, const FeatureScale& scale,
                      const TriangulationConfig& config) {
  int made = 0;
  for (const int other : BestCovisible(map, keyframe, config.neighbours)) {
    made += TriangulatePair(map, keyframe, other, camera, scale, config);
  }
  return made;
}

}  // namespace slam
