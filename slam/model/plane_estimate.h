#pragma once

#include <Eigen/Core>
#include <cmath>

#include "slam/geometry/plane.h"

namespace slam {

/// Share of what a frame says that it errs by that comes again in every frame and does not average out:
/// at the borders of a surface, in depth that is smoothed. By simulation (docs/evaluation.md).
inline constexpr double kSharedError = 0.5;

/// What is known of a landmark plane's parameters, as information: heights over a reference
/// plane,
///   z(u, v) = a + b u + c v,   (u, v) metres from `origin_w` along `axes`, z along `normal_w`.
/// Every observation adds a height at its own centroid and two slopes, each with its variance,
/// so a desk seen at its left end is known well there and poorly at its right.
struct PlaneEstimate {
  Eigen::Vector3d origin_w = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_w = Eigen::Vector3d::UnitZ();  ///< unit, the reference plane's front
  Eigen::Matrix<double, 3, 2> axes = Eigen::Matrix<double, 3, 2>::Identity();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< inverse covariance of (a, b, c)
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();     ///< information times (a, b, c)
  double frames = 0.0;  ///< how many frames' worth that is, older ones faded
  /// Variance of where the cameras stood that saw it, along its normal, m^2: mean of the heights'
  /// own, as they weigh. Frames in a row are off the world together, so that many know it no better.
  double world_variance_m2 = 0.0;

  bool empty() const { return !(information(0, 0) > 0); }

  /// (1, u, v): the height at the foot of x_w is this times (a, b, c).
  Eigen::Vector3d Lever(const Eigen::Vector3d& x_w) const {
    const Eigen::Vector2d q = axes.transpose() * (x_w - origin_w);
    return {1.0, q.x(), q.y()};
  }
  Eigen::Matrix3d Covariance() const;
  /// That of (n, d) in the world: with what all frames err by alike (kSharedError), and
  /// `world_variance_m2`. n . x + d at a point x_w has the variance (x_w, 1)^T C (x_w, 1). Of rank
  /// three, as n is unit. @pre not empty.
  Eigen::Matrix4d WorldCovariance() const;
  /// Variance of the slope in the direction in which it is known least, radians^2: the larger
  /// eigenvalue, which does not depend on how the axes lie.
  static double WorstSlopeVariance(const Eigen::Matrix3d& covariance) {
    const double b = covariance(1, 1), c = covariance(2, 2);
    return 0.5 * (b + c) + std::hypot(0.5 * (b - c), covariance(1, 2));
  }
  /// The most likely plane, front as the reference. @pre not empty.
  Plane Mean() const;
};

/// Adds one observation. The first one sets the reference.
/// @param keep  share of the old information that is kept, (0, 1]: errors of neighbouring
///              frames are alike, so a thousand frames do not know a thousand times as much as
///              one
/// @param world_variance_m2  of the camera's place in the world, along the normal
void AddObservation(PlaneEstimate& estimate, const Plane& pi_w,
                    const Eigen::Vector3d& centroid_w, double angle_sigma_rad,
                    double offset_sigma_m, double keep, double world_variance_m2 = 0.0);

}  // namespace slam
