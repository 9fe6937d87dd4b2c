#pragma once

#include <Eigen/Core>

#include "slam/geometry/pose.h"

namespace slam {

/// Oriented plane in Hessian form pi = (n, d): every x on it has n . x + d = 0.
///
/// A variable carries its frame: pi_c (camera), pi_w (world). The positive side is the front; a
/// plane measured by a camera faces it, so d_c > 0. Data in another convention (some libraries
/// write n . x - d = 0) is converted where it enters, never later.
struct Plane {
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();  ///< unit normal, towards the front
  double d = 0.0;                                ///< metres; > 0: the origin is in front
};

/// Signed distance from the plane to x, metres; positive in front. One frame for both.
inline double SignedDistance(const Plane& pi_a, const Eigen::Vector3d& x_a) {
  return pi_a.n.dot(x_a) + pi_a.d;
}

/// Foot of x on the plane.
inline Eigen::Vector3d ProjectOnto(const Plane& pi_a, const Eigen::Vector3d& x_a) {
  return x_a - SignedDistance(pi_a, x_a) * pi_a.n;
}

/// Re-expresses a plane in another frame:
///   n_c = R_cw n_w,   d_c = d_w - t_cw . n_c        (pi_c = T_cw^{-T} pi_w)
/// Source: PAS-SLAM eq15 (the transform only; the residual is in slam/pose/factors).
/// @throws std::invalid_argument if |n_w| differs from 1 by more than 1e-9.
Plane Transform(const Pose& T_cw, const Plane& pi_w);

/// The same plane with its front on the origin's side (d >= 0), as a camera measures it.
Plane FacingOrigin(const Plane& pi);

/// Angle between two oriented normals, radians in [0, pi]; exact near 0 and pi (atan2 of cross
/// and dot).
double Angle(const Eigen::Vector3d& n_1, const Eigen::Vector3d& n_2);

/// Two unit vectors that make (e_1, e_2, n) right-handed and orthonormal; continuous in n
/// except where n.z() changes sign.
/// @throws std::invalid_argument if n is not unit.
Eigen::Matrix<double, 3, 2> TangentBasis(const Eigen::Vector3d& n);

}  // namespace slam
