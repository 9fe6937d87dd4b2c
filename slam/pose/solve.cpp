#include "slam/pose/solve.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace slam {
namespace {

constexpr double kSmallStep = 1e-10;     // metres and radians: below any meaning
constexpr double kNullRatio = 1e-9;      // relative eigenvalue of an unobservable direction
constexpr double kDiagonalFloor = 1e-9;  // of the largest in its block: below is rounding

/// Diagonal of H, floored in each block so that rounding is not taken for curvature.
Vector6d Curvature(const Matrix6d& H) {
  Vector6d d = H.diagonal();
  const double floor_t = kDiagonalFloor * d.head<3>().maxCoeff();
  const double floor_r = kDiagonalFloor * d.tail<3>().maxCoeff();
  for (int i = 0; i < 6; ++i) d[i] = std::max(d[i], i < 3 ? floor_t : floor_r);
  return d;
}

}  // namespace

int Nullity(const Matrix6d& H) {
  if (!H.allFinite()) return 6;
  Vector6d scale = Curvature(H);
  for (int i = 0; i < 6; ++i) scale[i] = scale[i] > 0 ? 1.0 / std::sqrt(scale[i]) : 0.0;
  const Matrix6d S = scale.asDiagonal() * H * scale.asDiagonal();
  const Vector6d values =
      Eigen::SelfAdjointEigenSolver<Matrix6d>(S, Eigen::EigenvaluesOnly).eigenvalues();
  const double largest = values[5];
  if (!(largest > 0)) return 6;
  return static_cast<int>((values.array() < kNullRatio * largest).count());
}

namespace solve_detail {

Vector6d DampedStep(const NormalEquations& at, double lambda) {
  Matrix6d A = at.H.selfadjointView<Eigen::Upper>();
  Vector6d damping = Curvature(A);
  // A direction without any curvature must not make the system singular.
  for (int i = 0; i < 6; ++i) damping[i] = damping[i] > 0 ? damping[i] : 1.0;
  A.diagonal() += lambda * damping;
  return A.ldlt().solve(-at.g);
}

bool Finite(const NormalEquations& at) {
  return std::isfinite(at.cost) && at.H.allFinite() && at.g.allFinite();
}

bool StepIsSmall(const Vector6d& xi) { return xi.cwiseAbs().maxCoeff() < kSmallStep; }

}  // namespace solve_detail
}  // namespace slam
