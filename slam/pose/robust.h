#pragma once

#include <cmath>

namespace slam {

/// Huber's loss of a whitened residual of norm e, threshold delta (both in sigmas):
///   rho = e^2 / 2 for e <= delta,  delta (e - delta / 2) beyond.
struct HuberLoss {
  double cost = 0.0;    ///< rho
  double weight = 1.0;  ///< rho'(e) / e in (0, 1]: multiplies J^T J and J^T r
};

/// @param e2  squared norm, >= 0
/// @param delta  threshold; <= 0 means none (least squares)
inline HuberLoss Huber(double e2, double delta) {
  if (!(delta > 0) || e2 <= delta * delta) return {0.5 * e2, 1.0};
  const double e = std::sqrt(e2);
  return {delta * (e - 0.5 * delta), delta / e};
}

}  // namespace slam
