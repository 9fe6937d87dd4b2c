#include "slam/geometry/plane.h"

#include <cmath>

#include "slam/base/require.h"

namespace slam {
namespace {

constexpr double kUnitTolerance = 1e-9;  // rounding of long products stays far below

bool IsUnit(const Eigen::Vector3d& n) { return std::abs(n.norm() - 1.0) <= kUnitTolerance; }

}  // namespace

Plane Transform(const Pose& T_cw, const Plane& pi_w) {
  Require(IsUnit(pi_w.n), "Transform: the plane's normal is not unit");
  const Eigen::Vector3d n_c = T_cw.R * pi_w.n;  // eq15
  return {n_c, pi_w.d - T_cw.t.dot(n_c)};
}

Plane FacingOrigin(const Plane& pi) { return pi.d < 0 ? Plane{-pi.n, -pi.d} : pi; }

double Angle(const Eigen::Vector3d& n_1, const Eigen::Vector3d& n_2) {
  return std::atan2(n_1.cross(n_2).norm(), n_1.dot(n_2));
}

Eigen::Matrix<double, 3, 2> TangentBasis(const Eigen::Vector3d& n) {
  Require(IsUnit(n), "TangentBasis: the normal is not unit");
  // Duff et al. 2017, "Building an orthonormal basis, revisited": no square root, no branch on
  // small components.
  const double s = std::copysign(1.0, n.z());
  const double a = -1.0 / (s + n.z());
  const double b = n.x() * n.y() * a;
  Eigen::Matrix<double, 3, 2> E;
  E.col(0) << 1.0 + s * n.x() * n.x() * a, s * b, -s * n.x();
  E.col(1) << b, s + n.y() * n.y() * a, -n.y();
  return E;
}

}  // namespace slam
