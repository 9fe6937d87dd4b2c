#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

#include "slam/geometry/plane.h"

namespace slam {

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

  bool empty() const { return !(information(0, 0) > 0); }

  /// (1, u, v): the height at the foot of x_w is this times (a, b, c).
  Eigen::Vector3d Lever(const Eigen::Vector3d& x_w) const {
    const Eigen::Vector2d q = axes.transpose() * (x_w - origin_w);
    return {1.0, q.x(), q.y()};
  }
  Eigen::Matrix3d Covariance() const {
    return information.ldlt().solve(Eigen::Matrix3d::Identity());
  }
  /// Variance of the slope in the direction in which it is known least, radians^2: the larger
  /// eigenvalue, which does not depend on how the axes lie.
  static double WorstSlopeVariance(const Eigen::Matrix3d& covariance) {
    const double b = covariance(1, 1), c = covariance(2, 2);
    return 0.5 * (b + c) + std::hypot(0.5 * (b - c), covariance(1, 2));
  }
  /// The most likely plane, front as the reference. @pre not empty.
  Plane Mean() const {
    const Eigen::Vector3d abc = information.ldlt().solve(weighted);
    const Eigen::Vector3d n = (normal_w - axes * abc.tail<2>()).normalized();
    return {n, -n.dot(origin_w + abc[0] * normal_w)};
  }
};

/// Adds one observation. The first one sets the reference.
/// @param keep  share of the old information that is kept, (0, 1]: errors of neighbouring
///              frames are alike, so a thousand frames do not know a thousand times as much as
///              one
inline void AddObservation(PlaneEstimate& estimate, const Plane& pi_w,
                           const Eigen::Vector3d& centroid_w, double angle_sigma_rad,
                           double offset_sigma_m, double keep) {
  constexpr double kMinCosine = 0.5;  // a slope of 60 degrees is not the same plane
  const Eigen::Vector3d foot_w = ProjectOnto(pi_w, centroid_w);
  if (estimate.empty()) {
    estimate.origin_w = foot_w;
    estimate.normal_w = pi_w.n;
    estimate.axes = TangentBasis(pi_w.n);
  }
  const double cosine = pi_w.n.dot(estimate.normal_w);
  if (!(cosine > kMinCosine)) return;
  // What was observed: two slopes, and a height at the foot of the centroid.
  const Eigen::Vector2d slope = -(estimate.axes.transpose() * pi_w.n) / cosine;
  const Eigen::Vector3d lever = estimate.Lever(foot_w);
  const double height = estimate.normal_w.dot(foot_w - estimate.origin_w);
  const double w_z = 1.0 / (offset_sigma_m * offset_sigma_m);
  const double w_s = 1.0 / (angle_sigma_rad * angle_sigma_rad);
  // The old information fades, the new one is added in the form of normal equations.
  estimate.information *= keep;
  estimate.weighted *= keep;
  estimate.information += w_z * lever * lever.transpose();
  estimate.information(1, 1) += w_s;
  estimate.information(2, 2) += w_s;
  estimate.weighted += w_z * height * lever;
  estimate.weighted.tail<2>() += w_s * slope;
}

}  // namespace slam
