#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace slam {

/// Rigid motion T_ab: takes coordinates in b to coordinates in a, x_a = R x_b + t.
///
/// A variable carries its frames and adjacent letters cancel: T_ab * T_bc = T_ac. Frames of the
/// estimator: w world (the first camera), c current camera, r reference keyframe.
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();  ///< metres

  Eigen::Vector3d operator*(const Eigen::Vector3d& x_b) const { return R * x_b + t; }
  Pose operator*(const Pose& T_bc) const { return {R * T_bc.R, R * T_bc.t + t}; }
};

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// T_ba of T_ab.
Pose Inverse(const Pose& T_ab);

/// The nearest pose with an orthonormal R: call it after long products.
Pose Normalised(const Pose& T_ab);

/// a x b = Hat(a) b.
Eigen::Matrix3d Hat(const Eigen::Vector3d& a);

/// Rotation vector (axis times angle, radians) to rotation and back; Log's angle is in [0, pi].
Eigen::Matrix3d ExpSo3(const Eigen::Vector3d& omega_rad);
Eigen::Vector3d LogSo3(const Eigen::Matrix3d& R);

/// The smallest rotation that turns one direction into the other.
Eigen::Matrix3d RotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// xi = (rho, omega): translational part in metres first, then the rotation vector.
///   Exp(xi) = (exp(omega^), J_l(omega) rho)
Pose Exp(const Vector6d& xi);
/// Inverse of Exp for rotations below pi.
Vector6d Log(const Pose& T);

/// Carries a step to the other side of a pose: T Exp(xi) = Exp(Adjoint(T) xi) T.
Matrix6d Adjoint(const Pose& T);

/// Angle of the rotation between two poses, radians in [0, pi].
double RotationAngle(const Pose& T_1, const Pose& T_2);

}  // namespace slam
