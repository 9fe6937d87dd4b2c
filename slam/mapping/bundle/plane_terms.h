#pragma once

#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <array>

#include "slam/mapping/bundle/bundle_terms.h"
#include "slam/model/measured_plane.h"
#include "slam/model/plane_estimate.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// A plane as the solver holds it: (n, e), the unit normal and the signed distance of a
/// reference point that stays, in the middle of the patch. So neither the steps nor their
/// damping depend on where the world's origin lies.
using PlaneBlock = std::array<double, 4>;

PlaneBlock BlockOf(const Plane& pi_w, const Eigen::Vector3d& reference_w);
Plane PlaneOf(const double* block, const Eigen::Vector3d& reference_w);

/// Steps of three degrees of freedom: a turn of the normal, radians along two tangents, and a
/// shift. No pole: Ceres' own sphere loses half its digits at one (2.1).
class PlaneManifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 4; }
  int TangentSize() const override { return 3; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  /// @returns false for normals that are opposite
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

/// Residual of a keyframe's plane, in sigmas:
///   ( turn from n_c to R_cw n_w / angle_sigma,  (n_p . x + d_p) / offset_sigma ),
/// (n_p, d_p) the landmark in the camera and x the measured patch's centroid (PlaneFactor). Two
/// planes face to face have the residual kRefused and no derivative.
/// Source: PAS-SLAM eq15, eq16 (corrected as in slam/pose/factors/plane.h), the plane unknown too.
class PlaneTerm : public ceres::SizedCostFunction<4, 7, 4> {
 public:
  static constexpr double kRefused = BundleTerm::kBehind;  ///< sigmas; far beyond any gate

  PlaneTerm(const MeasuredPlane& seen, const Eigen::Vector3d& reference_w);
  /// parameters: PoseBlock, PlaneBlock. Jacobians: by xi (see PoseManifold) and by (n, e).
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  PlaneConstraint measured_;  ///< but for pi_w
  Eigen::Vector3d reference_w_;
};

/// Residual of a landmark against what is known of it besides, in sigmas: the heights (a, b, c)
/// of the plane over the estimate's reference plane, minus their mean, by the root of their
/// information.
class PlanePriorTerm : public ceres::SizedCostFunction<3, 4> {
 public:
  /// @pre estimate is not empty
  PlanePriorTerm(const PlaneEstimate& estimate, const Eigen::Vector3d& reference_w);
  /// parameters: PlaneBlock. @returns false when it is turned from the reference by 60 degrees
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  PlaneEstimate estimate_;
  Eigen::Vector3d reference_w_, mean_;
  Eigen::Matrix3d root_information_;
};

/// Residual of a map point that lies on a landmark: its distance, in sigmas.
/// Source: PAS-SLAM eq18, between map and map.
class PointOnPlaneTerm : public ceres::SizedCostFunction<1, 3, 4> {
 public:
  PointOnPlaneTerm(double sigma_m, const Eigen::Vector3d& reference_w)
      : weight_(1.0 / sigma_m), reference_w_(reference_w) {}
  /// parameters: p_w, PlaneBlock.
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  double weight_;
  Eigen::Vector3d reference_w_;
};

}  // namespace slam
