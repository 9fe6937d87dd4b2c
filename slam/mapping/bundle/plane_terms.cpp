#include "slam/mapping/bundle/plane_terms.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "slam/pose/factors/plane.h"

namespace slam {

PlaneBlock BlockOf(const Plane& pi_w, const Eigen::Vector3d& reference_w) {
  return {pi_w.n.x(), pi_w.n.y(), pi_w.n.z(), SignedDistance(pi_w, reference_w)};
}

Plane PlaneOf(const double* block, const Eigen::Vector3d& reference_w) {
  const Eigen::Vector3d n = Eigen::Map<const Eigen::Vector3d>(block).normalized();
  return {n, block[3] - n.dot(reference_w)};
}

bool PlaneManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const Eigen::Map<const Eigen::Vector3d> n(x);
  const Eigen::Vector3d step = TangentBasis(n) * Eigen::Map<const Eigen::Vector2d>(delta);
  const double turn = step.norm();
  const double sinc = turn > 0 ? std::sin(turn) / turn : 1.0;
  Eigen::Map<Eigen::Vector3d>{x_plus_delta} = (std::cos(turn) * n + sinc * step).normalized();
  x_plus_delta[3] = x[3] + delta[2];
  return true;
}

bool PlaneManifold::PlusJacobian(const double* x, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 4, 3, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.topLeftCorner<3, 2>() = TangentBasis(Eigen::Map<const Eigen::Vector3d>(x));
  J(3, 2) = 1.0;
  return true;
}

bool PlaneManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  const Eigen::Map<const Eigen::Vector3d> n_y(y), n_x(x);
  const NormalDifference turn = TurnBetween(n_x, n_y);
  // The turn's axis stands at a right angle to the step.
  const Eigen::Vector3d step = turn.r.cross(n_x);
  Eigen::Map<Eigen::Vector2d>{y_minus_x} = TangentBasis(n_x).transpose() * step;
  y_minus_x[2] = y[3] - x[3];
  return turn.valid;
}

bool PlaneManifold::MinusJacobian(const double* x, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.topLeftCorner<2, 3>() = TangentBasis(Eigen::Map<const Eigen::Vector3d>(x)).transpose();
  J(2, 3) = 1.0;
  return true;
}

PlaneTerm::PlaneTerm(const MeasuredPlane& seen, const Eigen::Vector3d& reference_w)
    : reference_w_(reference_w) {
  measured_.pi_c = seen.pi_c;
  measured_.centroid_c = seen.centroid_c;
  measured_.angle_sigma_rad = seen.angle_sigma_rad;
  measured_.offset_sigma_m = seen.offset_sigma_m;
}

bool PlaneTerm::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  const Pose T_cw = PoseOf(parameters[0]);
  PlaneConstraint c = measured_;
  c.pi_w = PlaneOf(parameters[1], reference_w_);
  const Linearised<4> f = PlaneFactor(c, T_cw);  // eq16
  Eigen::Vector4d weight = Eigen::Vector4d::Constant(1.0 / c.angle_sigma_rad);
  weight[3] = 1.0 / c.offset_sigma_m;
  if (!f.valid) weight.setZero();
  Eigen::Map<Eigen::Vector4d> r(residuals);
  r = weight.cwiseProduct(f.r);
  if (!f.valid) r.setConstant(kRefused);
  if (jacobians == nullptr) return true;

  if (jacobians[0] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 4, 7, Eigen::RowMajor>> by_pose(jacobians[0]);
    by_pose.leftCols<6>() = weight.asDiagonal() * f.J;
    by_pose.col(6).setZero();
  }
  if (jacobians[1] != nullptr) {
    // The turn by the normal in the camera; the offset by both, where the patch is in the world.
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> by_plane(jacobians[1]);
    const Eigen::Vector3d x_c = ProjectOnto(c.pi_c, c.centroid_c);
    const Eigen::Vector3d x_w = T_cw.R.transpose() * (x_c - T_cw.t);
    by_plane.topLeftCorner<3, 3>() = TurnBetween(c.pi_c.n, T_cw.R * c.pi_w.n).dr_dn2 * T_cw.R;
    by_plane.topRightCorner<3, 1>().setZero();
    by_plane.bottomLeftCorner<1, 3>() = (x_w - reference_w_).transpose();
    by_plane(3, 3) = 1.0;
    by_plane = weight.asDiagonal() * by_plane;
  }
  return true;
}

PlanePriorTerm::PlanePriorTerm(const PlaneEstimate& estimate,
                               const Eigen::Vector3d& reference_w)
    : estimate_(estimate),
      reference_w_(reference_w),
      mean_(estimate.information.ldlt().solve(estimate.weighted)),
      root_information_(estimate.information.llt().matrixU()) {}

bool PlanePriorTerm::Evaluate(double const* const* parameters, double* residuals,
                              double** jacobians) const {
  constexpr double kMinCosine = 0.5;  // beyond 60 degrees the heights say little of the plane
  const Eigen::Vector3d n = Eigen::Map<const Eigen::Vector3d>(parameters[0]);
  const Eigen::Vector3d from_reference = estimate_.origin_w - reference_w_;
  const double cosine = n.dot(estimate_.normal_w);
  if (!(cosine > kMinCosine)) return false;
  // Slopes along the axes, and the height over the origin.
  Eigen::Vector3d abc;
  abc[0] = -(n.dot(from_reference) + parameters[0][3]) / cosine;
  abc.tail<2>() = -(estimate_.axes.transpose() * n) / cosine;
  Eigen::Map<Eigen::Vector3d>{residuals} = root_information_ * (abc - mean_);
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;

  Eigen::Matrix<double, 3, 4> by_plane = Eigen::Matrix<double, 3, 4>::Zero();
  by_plane.block<1, 3>(0, 0) = -(from_reference + abc[0] * estimate_.normal_w).transpose();
  by_plane(0, 3) = -1.0;
  by_plane.block<2, 3>(1, 0) =
      -(estimate_.axes.transpose() + abc.tail<2>() * estimate_.normal_w.transpose());
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>{jacobians[0]} =
      root_information_ * by_plane / cosine;
  return true;
}

bool PointOnPlaneTerm::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
  const Eigen::Vector3d offset =
      Eigen::Map<const Eigen::Vector3d>(parameters[0]) - reference_w_;
  const Eigen::Map<const Eigen::Vector3d> n(parameters[1]);
  residuals[0] = weight_ * (n.dot(offset) + parameters[1][3]);  // eq18
  if (jacobians == nullptr) return true;
  if (jacobians[0] != nullptr) Eigen::Map<Eigen::Vector3d>{jacobians[0]} = weight_ * n;
  if (jacobians[1] != nullptr) {
    Eigen::Map<Eigen::Vector4d>{jacobians[1]} << weight_ * offset, weight_;
  }
  return true;
}

}  // namespace slam
