#include "slam/pose/pose_error.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <numeric>
#include <vector>

namespace slam {
namespace {

/// Mean distance along the optical axis of the planes' middles, of the points in a frame without
/// planes; 0 without either.
double MeanDepth_m(const Frame& frame) {
  std::vector<double> depths_m;
  for (const FramePlane& plane : frame.planes) depths_m.push_back(plane.centroid_c.z());
  if (depths_m.empty()) {
    for (const PointFeature& feature : frame.features)
      if (feature.depth_m > 0) depths_m.push_back(feature.depth_m);
  }
  const double sum_m = std::accumulate(depths_m.begin(), depths_m.end(), 0.0);
  return depths_m.empty() ? 0.0 : sum_m / static_cast<double>(depths_m.size());
}

}  // namespace

Matrix6d BendCovariance(const Frame& frame) {
  return IsotropicCovariance(frame.bend_ratio * MeanDepth_m(frame), frame.bend_ratio);
}

Matrix6d ShutterCovariance(const Frame& frame) {
  // The outermost rows are read half of the time before and after the middle one.
  const double half_s = 0.5 * frame.readout.sigma_s;
  return IsotropicCovariance(half_s * frame.readout.speed.head<3>().norm(),
                             half_s * frame.readout.speed.tail<3>().norm());
}

Matrix6d PoseErrorCovariance(const Frame& frame) {
  if (!frame.pose_covariance) return Matrix6d::Zero();
  return *frame.pose_covariance + BendCovariance(frame) + ShutterCovariance(frame);
}

Matrix6d CovarianceInWorld(const Frame& frame) {
  if (!frame.pose_covariance) return Matrix6d::Zero();
  if (frame.map_covariance.isZero(0.0)) return *frame.pose_covariance;
  return AtLeast(*frame.pose_covariance, frame.map_covariance);
}

Matrix6d WorldErrorCovariance(const Frame& frame) {
  if (!frame.pose_covariance) return Matrix6d::Zero();
  return CovarianceInWorld(frame) + BendCovariance(frame) + ShutterCovariance(frame);
}

Eigen::Matrix3d PlaceCovariance(const Pose& T_cw, const Matrix6d& covariance) {
  return T_cw.R.transpose() * covariance.topLeftCorner<3, 3>() * T_cw.R;
}

double VarianceAlong(const Matrix6d& covariance, const Eigen::Vector3d& n_c,
                     const Eigen::Vector3d& x_c) {
  const Vector6d by_pose = (Vector6d() << n_c, x_c.cross(n_c)).finished();
  return by_pose.dot(covariance * by_pose);
}

Matrix6d AtLeast(const Matrix6d& covariance, const Matrix6d& bound) {
  const Eigen::LLT<Matrix6d> root(covariance);
  if (root.info() != Eigen::Success) return covariance + bound;
  // In the axes in which the one is a sphere of radius 1, the other's are its own.
  const Matrix6d half = root.matrixL().solve(bound);
  const Matrix6d rounded = root.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix6d> axes(rounded);
  const Matrix6d back = root.matrixL() * axes.eigenvectors();
  return back * axes.eigenvalues().cwiseMax(1.0).asDiagonal() * back.transpose();
}

}  // namespace slam
