#include "slam/mapping/bundle/bundle_terms.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "slam/pose/factors/point.h"

namespace slam {

PoseBlock BlockOf(const Pose& T_cw) {
  const Eigen::Quaterniond q(T_cw.R);
  return {T_cw.t.x(), T_cw.t.y(), T_cw.t.z(), q.x(), q.y(), q.z(), q.w()};
}

Pose PoseOf(const double* block) {
  const Eigen::Quaterniond q(block[6], block[3], block[4], block[5]);
  return {q.normalized().toRotationMatrix(), {block[0], block[1], block[2]}};
}

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const Vector6d xi = Eigen::Map<const Vector6d>(delta);
  const PoseBlock moved = BlockOf(Exp(xi) * PoseOf(x));
  std::copy(moved.begin(), moved.end(), x_plus_delta);
  return true;
}

bool PoseManifold::PlusJacobian(const double* /*x*/, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>(jacobian).setIdentity();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Vector6d>{y_minus_x} = Log(PoseOf(y) * Inverse(PoseOf(x)));
  return true;
}

bool PoseManifold::MinusJacobian(const double* /*x*/, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>>(jacobian).setIdentity();
  return true;
}

bool BundleTerm::Evaluate(double const* const* parameters, double* residuals,
                          double** jacobians) const {
  const Pose T_cw = PoseOf(parameters[0]);
  const Eigen::Vector3d x_c = T_cw * Eigen::Map<const Eigen::Vector3d>(parameters[1]);
  const PointResidual residual = ResidualOf(seen_, x_c, camera_);
  Eigen::Map<Eigen::Vector3d>{residuals} =
      residual.valid ? residual.r : Eigen::Vector3d(kBehind, kBehind, 0.0);
  if (jacobians == nullptr) return true;
  // By the point in the camera, then by the chain rule by pose and point.
  if (jacobians[0] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 3, 7, Eigen::RowMajor>> by_pose(jacobians[0]);
    by_pose.leftCols<6>() = residual.by_x_c * PointJacobian(x_c);
    by_pose.col(6).setZero();
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{jacobians[1]} =
        residual.by_x_c * T_cw.R;
  }
  return true;
}

bool StayTerm::Evaluate(double const* const* parameters, double* residuals,
                        double** jacobians) const {
  const Vector6d xi = Log(PoseOf(parameters[0]) * T_wc_before_);
  Vector6d weight;
  weight << Eigen::Vector3d::Constant(1.0 / kSigma_m),
      Eigen::Vector3d::Constant(1.0 / kSigma_rad);
  Eigen::Map<Vector6d>{residuals} = weight.cwiseProduct(xi);
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  // The left Jacobian's inverse, to the second order in xi; the third order vanishes.
  Matrix6d ad = Matrix6d::Zero();
  ad.topLeftCorner<3, 3>() = ad.bottomRightCorner<3, 3>() = Hat(xi.tail<3>());
  ad.topRightCorner<3, 3>() = Hat(xi.head<3>());
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobians[0]);
  J.leftCols<6>() = weight.asDiagonal() * (Matrix6d::Identity() - ad / 2 + ad * ad / 12);
  J.col(6).setZero();
  return true;
}

}  // namespace slam
