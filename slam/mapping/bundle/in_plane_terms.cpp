#include "slam/mapping/bundle/in_plane_terms.h"

#include "slam/pose/factors/vertex.h"

namespace slam {

PlaneAxes::PlaneAxes(const Plane& start_w, const Eigen::Vector3d& reference)
    : reference_w(reference) {
  axes << TangentBasis(start_w.n), start_w.n;
}

InPlaneBlock PlaneAxes::BlockOf(const Eigen::Vector3d& p_w) const {
  const Eigen::Vector2d along = axes.leftCols<2>().transpose() * (p_w - reference_w);
  return {along.x(), along.y()};
}

InPlanePoint PointOf(const PlaneAxes& axes, const double* plane, const double* point) {
  constexpr double kMinCosine = 0.5;  // as of PlanePriorTerm
  InPlanePoint out;
  const Eigen::Map<const Eigen::Vector3d> n(plane);
  const Eigen::Vector3d up = axes.axes.col(2);
  const double cosine = n.dot(up);
  if (!(cosine > kMinCosine)) return out;
  // n . (x - reference) + e = 0, x - reference = along + height up.
  const Eigen::Vector3d along =
      axes.axes.leftCols<2>() * Eigen::Map<const Eigen::Vector2d>(point);
  const double height = -(n.dot(along) + plane[3]) / cosine;
  const Eigen::Vector3d from_reference = along + height * up;
  out.p_w = axes.reference_w + from_reference;
  out.by_plane.leftCols<3>() = up * from_reference.transpose() / -cosine;
  out.by_plane.col(3) = up / -cosine;
  out.by_point =
      axes.axes.leftCols<2>() - up * (n.transpose() * axes.axes.leftCols<2>()) / cosine;
  out.valid = true;
  return out;
}

bool VertexTerm::Evaluate(double const* const* parameters, double* residuals,
                          double** jacobians) const {
  const Pose T_cw = PoseOf(parameters[0]);
  VertexConstraint c = measured_;
  c.p_w = Eigen::Map<const Eigen::Vector3d>(parameters[1]);
  const Linearised<2> f = VertexFactor(c, T_cw);
  Eigen::Map<Eigen::Vector2d>{residuals} = f.r;
  if (jacobians == nullptr) return true;
  if (jacobians[0] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, 7, Eigen::RowMajor>> by_pose(jacobians[0]);
    by_pose.leftCols<6>() = f.J;
    by_pose.col(6).setZero();
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>>{jacobians[1]} =
        c.sqrt_information * T_cw.R;
  }
  return true;
}

}  // namespace slam
