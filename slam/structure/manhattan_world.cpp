#include "slam/structure/manhattan_world.h"

#include <array>
#include <cmath>

namespace slam {
namespace {

/// The normal, either way, when it lies within the cone about an axis.
std::optional<Eigen::Vector3d> Along(const Eigen::Vector3d& n, const Eigen::Vector3d& axis,
                                     double max_angle_rad) {
  const Eigen::Vector3d towards = n.dot(axis) < 0 ? Eigen::Vector3d(-n) : n;
  if (!(Angle(towards, axis) < max_angle_rad)) return std::nullopt;
  return towards;
}

std::vector<const MapPlane*> LargeLandmarks(const MapPlanes& planes,
                                            const ManhattanConfig& config) {
  std::vector<const MapPlane*> large;
  for (const MapPlane& plane : planes) {
    if (plane.status == LandmarkStatus::kLandmark && plane.area_m2 > config.min_area_m2 &&
        plane.observations >= config.min_observations) {
      large.push_back(&plane);
    }
  }
  return large;
}

/// Area of all landmarks along the axes; 0 when one of the axes has too little.
double AreaAlong(const std::vector<const MapPlane*>& landmarks, const Eigen::Matrix3d& axes_w,
                 const ManhattanConfig& config) {
  std::array<double, 3> area_m2{};
  for (const MapPlane* plane : landmarks) {
    for (int k = 0; k < 3; ++k) {
      if (Along(plane->pi_w.n, axes_w.col(k), config.max_axis_angle_rad))
        area_m2[static_cast<std::size_t>(k)] += plane->area_m2;
    }
  }
  for (const double area : area_m2) {
    if (!(area > config.min_axis_area_m2)) return 0.0;
  }
  return area_m2[0] + area_m2[1] + area_m2[2];
}

/// The axes turned onto the normals that lie along them, by area.
std::optional<Eigen::Matrix3d> Refined(const std::vector<const MapPlane*>& landmarks,
                                       const Eigen::Matrix3d& axes_w,
                                       const ManhattanConfig& config) {
  std::vector<AxisObservation> seen;
  for (const MapPlane* plane : landmarks) {
    for (int k = 0; k < 3; ++k) {
      const auto n = Along(plane->pi_w.n, axes_w.col(k), config.max_axis_angle_rad);
      if (n) seen.push_back({Eigen::Vector3d::Unit(k), *n, 1 / std::sqrt(plane->area_m2)});
    }
  }
  const auto turned = RotationFromAxes(seen, axes_w);
  return turned ? std::optional(turned->R_cw) : std::nullopt;
}

}  // namespace

std::optional<Eigen::Matrix3d> FindManhattanAxes(const MapPlanes& planes,
                                                 const ManhattanConfig& config) {
  const std::vector<const MapPlane*> landmarks = LargeLandmarks(planes, config);
  double most_m2 = 0.0;
  Eigen::Matrix3d best_w;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    for (std::size_t j = i + 1; j < landmarks.size(); ++j) {
      const Eigen::Vector3d &n_1 = landmarks[i]->pi_w.n, &n_2 = landmarks[j]->pi_w.n;
      if (!(std::abs(Angle(n_1, n_2) - 0.5 * M_PI) < config.max_axis_angle_rad)) continue;
      Eigen::Matrix3d axes_w;
      axes_w.col(0) = n_1;
      axes_w.col(1) = (n_2 - n_1.dot(n_2) * n_1).normalized();
      axes_w.col(2) = n_1.cross(axes_w.col(1));
      const double area_m2 = AreaAlong(landmarks, axes_w, config);
      if (area_m2 > most_m2) most_m2 = area_m2, best_w = axes_w;
    }
  }
  if (!(most_m2 > 0)) return std::nullopt;
  return Refined(landmarks, best_w, config);
}

std::vector<AxisObservation> SeenAxes(const Frame& frame, const Eigen::Matrix3d& axes_w,
                                      const ManhattanConfig& config) {
  std::vector<AxisObservation> seen;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis_c = frame.T_cw.R * axes_w.col(k);
    Eigen::Vector3d sum_c = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (const FramePlane& plane : frame.planes) {
      if (plane.bad || !(plane.area_m2 > config.min_area_m2)) continue;
      const auto n_c = Along(plane.pi_c.n, axis_c, config.max_axis_angle_rad);
      if (!n_c) continue;
      const double sigma = plane.AngleSigma_rad();
      sum_c += *n_c / (sigma * sigma);
      weights += 1 / (sigma * sigma);
    }
    // How square the world is does not average out over the planes of an axis.
    if (weights > 0)
      seen.push_back({axes_w.col(k), sum_c.normalized(),
                      std::sqrt(1 / weights + config.axis_sigma_rad * config.axis_sigma_rad)});
  }
  return seen;
}

}  // namespace slam
