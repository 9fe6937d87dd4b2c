#pragma once

#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <array>

#include "slam/geometry/camera.h"
#include "slam/model/frame.h"

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

/// Residual of one observation, in sigmas:
///   ( fx x/z + cx - u,  fy y/z + cy - v,  (b f / z - b f / z_measured) / depth_sigma ) / sigma
/// with (x, y, z) = T_cw p_w; the third is 0 for a feature without depth (eq14). A point nearer
/// than kMinProjectedDepth_m to the image plane, or behind it, has the residual kBehind and no
/// derivative.
class BundleTerm : public ceres::SizedCostFunction<3, 7, 3> {
 public:
  static constexpr double kBehind = 1e3;  ///< sigmas; far beyond any gate

  /// @param sigma_px     standard deviation of a position at the feature's octave
  /// @param depth_sigma  that of the disparity, relative to sigma_px
  BundleTerm(const PointFeature& feature, const Camera& camera, double bf_px_m, double sigma_px,
             double depth_sigma);
  /// parameters: PoseBlock, p_w. Jacobians: by xi (see PoseManifold) and by p_w.
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  bool EvaluateBehind(double* residuals, double** jacobians) const;

  Eigen::Vector2d u_px_;
  double disparity_px_;  ///< b f / z as measured; < 0 without depth
  double fx_, fy_, cx_, cy_, bf_px_m_;
  double weight_, depth_weight_;  ///< 1 / sigma
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
