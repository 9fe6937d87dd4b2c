#pragma once

#include <vector>

#include "eval/trajectory/statistics.h"

namespace app {

/// For a table: eval's quantile, and 0 where there is nothing to take one of.
inline double QuantileOrZero(const std::vector<double>& values, double fraction) {
  return values.empty() ? 0.0 : eval::Quantile(values, fraction);
}

}  // namespace app
