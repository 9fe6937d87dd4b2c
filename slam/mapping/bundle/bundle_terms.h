#pragma once

#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <array>

#include "slam/geometry/camera.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// A pose as the solver holds it: (t, q) of T_cw, q as (x, y, z, w).
using PoseBlock = std::array<double, 7>;

PoseBlock BlockOf(const Pose& T_cw);
Pose PoseOf(const double* block);

/// Steps T <- Exp(xi) T, xi = (rho, omega). Its Jacobian is declared as the first six of the
/// seven coordinates: terms deliver derivatives by xi there and zero in the seventh, so that no
/// product with the quaternion's derivative is ever formed.
class PoseManifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

/// Residual of one observation by pose and point, in sigmas (ResidualOf). A point nearer than
/// kMinProjectedDepth_m to the image plane, or behind it, has the residual kBehind and no
/// derivative.
class BundleTerm : public ceres::SizedCostFunction<3, 7, 3> {
 public:
  static constexpr double kBehind = 1e3;  ///< sigmas; far beyond any gate

  /// @param camera  outlives the term
  BundleTerm(const PointConstraint& seen, const Camera& camera)
      : seen_(seen), camera_(camera) {}
  /// parameters: PoseBlock, p_w. Jacobians: by xi (see PoseManifold) and by p_w.
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  PointConstraint seen_;
  const Camera& camera_;
};

/// Residual of a pose against where it was, Log(T_cw T_wc_before), in sigmas so wide that it
/// counts in directions alone that no measurement knows: there the pose stays.
class StayTerm : public ceres::SizedCostFunction<6, 7> {
 public:
  // Far beyond what an adjustment moves a keyframe by, and 1e-4 of what a hundred points know.
  static constexpr double kSigma_m = 0.1, kSigma_rad = 0.1;

  explicit StayTerm(const Pose& before_cw) : T_wc_before_(Inverse(before_cw)) {}
  /// parameters: PoseBlock. Jacobian: by xi (see PoseManifold).
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Pose T_wc_before_;
};

}  // namespace slam
