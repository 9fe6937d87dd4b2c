#include "eval/trajectory/nees.h"

#include <algorithm>

#include "eval/trajectory/statistics.h"

namespace eval {

Nees NeesOver(const std::vector<double>& values, const ChiSquareBand& band) {
  const auto described = Describe(values);
  const double n = static_cast<double>(values.size());
  const auto above = std::count_if(values.begin(), values.end(),
                                   [&](double value) { return value > band.high; });
  const auto below = std::count_if(values.begin(), values.end(),
                                   [&](double value) { return value < band.low; });
  return {described->mean, described->median, 1.0 - static_cast<double>(above + below) / n,
          static_cast<double>(above) / n};
}

}  // namespace eval
