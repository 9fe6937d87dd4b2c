#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "eval/formats/pose/pose.h"

namespace eval {

/// Oriented plane in Hessian form: every x on it has n . x + d = 0; positive side in front.
struct Plane {
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();  ///< unit normal
  double d = 0.0;                                ///< metres
};

/// Signed distance from the plane to x, metres; one frame for both.
inline double SignedDistance(const Plane& pi_a, const Eigen::Vector3d& x_a) {
  return pi_a.n.dot(x_a) + pi_a.d;
}

/// Re-expresses a plane: n_a = R_ab n_b, d_a = d_b - t_ab . n_a.
inline Plane Transform(const Pose& T_ab, const Plane& pi_b) {
  const Eigen::Vector3d n_a = T_ab.R * pi_b.n;
  return {n_a, pi_b.d - T_ab.t.dot(n_a)};
}

/// Angle between oriented normals, radians in [0, pi]; exact near 0 and pi.
inline double Angle(const Eigen::Vector3d& n_1, const Eigen::Vector3d& n_2) {
  return std::atan2(n_1.cross(n_2).norm(), n_1.dot(n_2));
}

}  // namespace eval
