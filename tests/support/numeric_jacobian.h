#pragma once

#include <Eigen/Core>

#include "slam/geometry/pose.h"

namespace slam {

/// Five-point central difference of r(Exp(xi) T) at xi = 0: error O(h^4) + eps / h, which is
/// about 1e-11 relative for smooth residuals of unit size at this step.
template <int kRows, typename Residual>
Eigen::Matrix<double, kRows, 6> NumericJacobian(const Pose& T_cw, const Residual& residual) {
  constexpr double h = 1e-3;
  Eigen::Matrix<double, kRows, 6> J;
  for (int i = 0; i < 6; ++i) {
    const auto at = [&](double step) -> Eigen::Matrix<double, kRows, 1> {
      Vector6d xi = Vector6d::Zero();
      xi[i] = step;
      return residual(Exp(xi) * T_cw);
    };
    J.col(i) = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
  }
  return J;
}

/// Largest difference relative to the size of the numeric one (at least 1).
template <typename A, typename B>
double JacobianError(const A& analytic, const B& numeric) {
  return (analytic - numeric).cwiseAbs().maxCoeff() /
         std::max(1.0, numeric.cwiseAbs().maxCoeff());
}

}  // namespace slam
