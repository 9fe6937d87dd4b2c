#include "slam/model/plane_estimate.h"

#include <Eigen/Cholesky>

namespace slam {

Eigen::Matrix3d PlaneEstimate::Covariance() const {
  return information.ldlt().solve(Eigen::Matrix3d::Identity());
}

Eigen::Matrix4d PlaneEstimate::WorldCovariance() const {
  // The mean of `frames` frames knows what one does, divided by their number, and the shared part.
  Eigen::Matrix3d covariance = (1.0 + kSharedError * kSharedError * frames) * Covariance();
  covariance(0, 0) += world_variance_m2;
  // n = normal_w - axes (b, c) and d = -n . (origin_w + a normal_w), to first order.
  Eigen::Matrix<double, 4, 3> jacobian;
  jacobian << Eigen::Vector3d::Zero(), -axes, Eigen::Matrix<double, 1, 1>(-1.0),
      origin_w.transpose() * axes;
  return jacobian * covariance * jacobian.transpose();
}

Plane PlaneEstimate::Mean() const {
  const Eigen::Vector3d abc = information.ldlt().solve(weighted);
  const Eigen::Vector3d n = (normal_w - axes * abc.tail<2>()).normalized();
  return {n, -n.dot(origin_w + abc[0] * normal_w)};
}

void AddObservation(PlaneEstimate& estimate, const Plane& pi_w,
                    const Eigen::Vector3d& centroid_w, double angle_sigma_rad,
                    double offset_sigma_m, double keep, double world_variance_m2) {
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
  estimate.frames = keep * estimate.frames + 1.0;
  estimate.information += w_z * lever * lever.transpose();
  estimate.information(1, 1) += w_s;
  estimate.information(2, 2) += w_s;
  estimate.weighted += w_z * height * lever;
  estimate.weighted.tail<2>() += w_s * slope;
  // The first entry of the information is the sum of the heights' weights.
  estimate.world_variance_m2 +=
      w_z / estimate.information(0, 0) * (world_variance_m2 - estimate.world_variance_m2);
}

}  // namespace slam
