#include "slam/faces/vertex_covariance.h"

#include <Eigen/LU>
#include <cmath>

namespace slam {
namespace {

/// Covariance of the pixel at which two lines cross.
Eigen::Matrix2d CrossingCovariance(const LineError& line_i, const LineError& line_j,
                                   const Eigen::Vector2d& u_px) {
  Eigen::Matrix2d normals;
  normals << -line_i.along.y(), line_i.along.x(), -line_j.along.y(), line_j.along.x();
  constexpr double kMinSine = 1e-6;  // only guards the division: corners are much squarer
  if (!(std::abs(normals.determinant()) > kMinSine)) return Eigen::Matrix2d::Zero();
  const Eigen::Matrix2d moved = normals.inverse();  // how the crossing moves with the lines
  const Eigen::Vector2d across(line_i.Variance(u_px), line_j.Variance(u_px));
  return moved * across.asDiagonal() * moved.transpose();
}

}  // namespace

Eigen::Matrix3d VertexCovariance(const FramePlane& plane, const LineError& line_i,
                                 const LineError& line_j, const Eigen::Vector3d& p_c,
                                 const Camera& camera) {
  // The corner x = ray / q depends on the pixel where the lines cross and on the plane's q.
  const Eigen::Vector3d ray = p_c / p_c.z();
  const Eigen::Vector3d g = -plane.pi_c.n / plane.pi_c.d;
  const double q = g.dot(ray);
  Eigen::Matrix<double, 3, 2> by_pixel;  // d(ray / q) / du
  by_pixel.col(0) = (Eigen::Vector3d::UnitX() - ray * (g.x() / q)) / (q * camera.fx);
  by_pixel.col(1) = (Eigen::Vector3d::UnitY() - ray * (g.y() / q)) / (q * camera.fy);
  const double variance_q = ray.dot(plane.inverse_depth_covariance * ray);
  const Eigen::Vector3d by_q = -ray / (q * q);
  return by_pixel * CrossingCovariance(line_i, line_j, camera.Project(p_c)) *
             by_pixel.transpose() +
         by_q * variance_q * by_q.transpose();
}

}  // namespace slam
