#include "eval/formats/covariance.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace eval {

bool IsCovariance(const Eigen::MatrixXd& C) {
  constexpr double kRoundOff = 1e-6;
  Eigen::VectorXd inverse_sigma(C.rows());
  for (Eigen::Index i = 0; i < C.rows(); ++i) {
    if (C(i, i) < 0.0) return false;
    if (C(i, i) == 0.0 && !C.row(i).isZero(0.0)) return false;
    inverse_sigma[i] = C(i, i) > 0.0 ? 1.0 / std::sqrt(C(i, i)) : 0.0;
  }
  const Eigen::MatrixXd correlations =
      inverse_sigma.asDiagonal() * C * inverse_sigma.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(correlations,
                                                            Eigen::EigenvaluesOnly);
  return axes.eigenvalues()[0] >= -kRoundOff;  // not so either where a number is too large
}

}  // namespace eval
