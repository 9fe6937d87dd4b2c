#pragma once

#include <ceres/sized_cost_function.h>

#include <array>

#include "slam/mapping/bundle/plane_terms.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// A point of a plane by two numbers: how far it lies from a reference point along two axes that
/// stay. Its height over them, along a third axis, is the plane's.
/// Source: co-planar parametrisation (Li, Li, Oernek, Lin, Tombari 2020).
using InPlaneBlock = std::array<double, 2>;

/// The axes of a PlaneBlock's points: two along the plane as it was, and its normal then.
struct PlaneAxes {
  Eigen::Vector3d reference_w;
  Eigen::Matrix3d axes;  ///< columns

  PlaneAxes(const Plane& start_w, const Eigen::Vector3d& reference);
  /// The plane's point under or over p_w, along the third axis.
  InPlaneBlock BlockOf(const Eigen::Vector3d& p_w) const;
};

/// Where the point lies, and how it moves with the plane and its own block.
struct InPlanePoint {
  bool valid = false;  ///< false where the plane is turned from the axes by 60 degrees
  Eigen::Vector3d p_w = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 4> by_plane;
  Eigen::Matrix<double, 3, 2> by_point;
};
InPlanePoint PointOf(const PlaneAxes& axes, const double* plane, const double* point);

/// Residual of a corner that a keyframe has seen, by pose and the corner's place: VertexFactor.
class VertexTerm : public ceres::SizedCostFunction<2, 7, 3> {
 public:
  /// @param seen  but for p_w
  explicit VertexTerm(const VertexConstraint& seen) : measured_(seen) {}
  /// parameters: PoseBlock, p_w. Jacobians: by xi (see PoseManifold) and by p_w.
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  VertexConstraint measured_;
};

/// The residual of a point, its place given by a plane and two numbers.
template <int kRows>
class InPlaneTerm : public ceres::SizedCostFunction<kRows, 7, 4, 2> {
 public:
  using PointTerm = ceres::SizedCostFunction<kRows, 7, 3>;

  /// @param of_point  outlives the term
  InPlaneTerm(const PointTerm& of_point, const PlaneAxes& axes)
      : of_point_(of_point), axes_(axes) {}
  /// parameters: PoseBlock, PlaneBlock, InPlaneBlock. Jacobians: by xi (see PoseManifold), by
  /// (n, e) and by the point's two numbers.
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const InPlanePoint point = PointOf(axes_, parameters[1], parameters[2]);
    if (!point.valid) return false;
    const double* blocks[] = {parameters[0], point.p_w.data()};
    if (jacobians == nullptr) return of_point_.Evaluate(blocks, residuals, nullptr);

    Eigen::Matrix<double, kRows, 3, Eigen::RowMajor> by_p_w;
    double* of_point[] = {jacobians[0], by_p_w.data()};
    if (!of_point_.Evaluate(blocks, residuals, of_point)) return false;
    if (jacobians[1] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, kRows, 4, Eigen::RowMajor>>{jacobians[1]} =
          by_p_w * point.by_plane;
    }
    if (jacobians[2] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, kRows, 2, Eigen::RowMajor>>{jacobians[2]} =
          by_p_w * point.by_point;
    }
    return true;
  }

 private:
  const PointTerm& of_point_;
  PlaneAxes axes_;
};

}  // namespace slam
