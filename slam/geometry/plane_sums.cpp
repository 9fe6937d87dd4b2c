#include "slam/geometry/plane_sums.h"

#include <Eigen/Eigenvalues>

namespace slam {

PlaneSigmas Sigmas(const PlaneSums& s, const InverseDepthPlane& plane, const DepthNoise& noise,
                   double scale) {
  Eigen::Matrix3d information;
  information << s.wxx, s.wxy, s.wx, s.wxy, s.wyy, s.wy, s.wx, s.wy, s.w;
  const Eigen::Matrix3d cov = information.inverse() * (scale * scale * noise.correlated_px);

  // n = -g / |g|, d = 1 / |g| with g = (a, b, c); first order about the estimate.
  const Eigen::Vector3d g(plane.a, plane.b, plane.c);
  const double norm = g.norm();
  const Eigen::Vector3d n = -g / norm;
  const Eigen::Matrix3d dn = -(Eigen::Matrix3d::Identity() - n * n.transpose()) / norm;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(dn * cov * dn.transpose(),
                                                              Eigen::EigenvaluesOnly);
  // The gap along the normal at a point X of the plane is -(dg . X) / |g|.
  const Eigen::Vector3d ray(s.wx / s.w, s.wy / s.w, 1.0);
  const Eigen::Vector3d X = ray / plane.InverseDepth(ray.x(), ray.y());
  const double variance = X.dot(cov * X) / (norm * norm);
  return {std::sqrt(std::max(variance, 0.0)),
          std::sqrt(std::max(spread.eigenvalues().maxCoeff(), 0.0)), cov};
}

}  // namespace slam
