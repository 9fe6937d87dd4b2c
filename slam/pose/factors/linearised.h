#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "slam/geometry/pose.h"

namespace slam {

/// A factor's residual r and its Jacobian for the left perturbation T_cw <- Exp(xi) T_cw,
/// xi = (rho, omega): a point of the camera frame moves by rho + omega x x_c.
/// `valid` is false where the factor says nothing (point behind the camera, opposite normals);
/// r and J are then zero, never NaN.
template <int kRows>
struct Linearised {
  Eigen::Matrix<double, kRows, 1> r = Eigen::Matrix<double, kRows, 1>::Zero();
  Eigen::Matrix<double, kRows, 6> J = Eigen::Matrix<double, kRows, 6>::Zero();
  bool valid = false;
};

/// d x_c / d xi = [ I, -Hat(x_c) ].
inline Eigen::Matrix<double, 3, 6> PointJacobian(const Eigen::Vector3d& x_c) {
  Eigen::Matrix<double, 3, 6> J;
  J.leftCols<3>().setIdentity();
  J.rightCols<3>() = -Hat(x_c);
  return J;
}

}  // namespace slam
