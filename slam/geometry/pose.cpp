#include "slam/geometry/pose.h"

#include <Eigen/SVD>
#include <cmath>

namespace slam {
namespace {

// Below this angle the series are exact to double precision and the closed forms lose digits.
constexpr double kSmallAngle_rad = 1e-4;

/// J_l(omega) = I + (1 - cos a)/a^2 w^ + (a - sin a)/a^3 (w^)^2 with w^ = Hat(omega), a =
/// |omega|.
Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& omega_rad) {
  const double a2 = omega_rad.squaredNorm();
  const double a = std::sqrt(a2);
  const Eigen::Matrix3d W = Hat(omega_rad);
  double b = 0.5 - a2 / 24.0, c = 1.0 / 6.0 - a2 / 120.0;
  if (a > kSmallAngle_rad) {
    const double s = std::sin(0.5 * a) / a;
    b = 2.0 * s * s;
    c = (a - std::sin(a)) / (a2 * a);
  }
  return Eigen::Matrix3d::Identity() + b * W + c * W * W;
}

}  // namespace

Pose Inverse(const Pose& T_ab) { return {T_ab.R.transpose(), -(T_ab.R.transpose() * T_ab.t)}; }

Pose Normalised(const Pose& T_ab) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(T_ab.R,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU() * svd.matrixV().transpose(), T_ab.t};
}

Eigen::Matrix3d Hat(const Eigen::Vector3d& a) {
  Eigen::Matrix3d A;
  A << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return A;
}

Eigen::Matrix3d ExpSo3(const Eigen::Vector3d& omega_rad) {
  const double a2 = omega_rad.squaredNorm();
  const double a = std::sqrt(a2);
  const double half_sinc =
      a > kSmallAngle_rad ? std::sin(0.5 * a) / a : 0.5 - a2 / 48.0 + a2 * a2 / 3840.0;
  const Eigen::Vector3d v = half_sinc * omega_rad;
  return Eigen::Quaterniond(std::cos(0.5 * a), v.x(), v.y(), v.z()).toRotationMatrix();
}

Eigen::Vector3d LogSo3(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double s = q.vec().norm();  // sin(a/2), exact also near pi
  const double scale =
      s > kSmallAngle_rad ? 2.0 * std::atan2(s, q.w()) / s : 2.0 * (1.0 + s * s / 6.0);
  return scale * q.vec();
}

Eigen::Matrix3d RotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

Pose Exp(const Vector6d& xi) {
  const Eigen::Vector3d rho = xi.head<3>(), omega = xi.tail<3>();
  return {ExpSo3(omega), LeftJacobian(omega) * rho};
}

Vector6d Log(const Pose& T) {
  Vector6d xi;
  xi.tail<3>() = LogSo3(T.R);
  const Eigen::Vector3d omega = xi.tail<3>();
  xi.head<3>() = LeftJacobian(omega).partialPivLu().solve(T.t);
  return xi;
}

Matrix6d Adjoint(const Pose& T) {
  Matrix6d adjoint = Matrix6d::Zero();
  adjoint.topLeftCorner<3, 3>() = adjoint.bottomRightCorner<3, 3>() = T.R;
  adjoint.topRightCorner<3, 3>() = Hat(T.t) * T.R;
  return adjoint;
}

double RotationAngle(const Pose& T_1, const Pose& T_2) {
  return LogSo3(T_1.R.transpose() * T_2.R).norm();
}

}  // namespace slam
