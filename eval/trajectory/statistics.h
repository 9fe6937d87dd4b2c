#pragma once

#include <optional>
#include <vector>

namespace eval {

/// What a list of errors comes to; the unit is that of the errors. rmse^2 = mean^2 + std^2.
struct Statistics {
  std::size_t count = 0;
  double rmse = 0.0, mean = 0.0, median = 0.0;
  double std_dev = 0.0;  ///< that of the population (ddof 0)
  double min = 0.0, max = 0.0, sse = 0.0;
};

/// Nothing for an empty list: no errors is not an error of zero.
std::optional<Statistics> Describe(const std::vector<double>& errors);

/// The value below which the share `fraction` in [0, 1] lies, linear between ranks (median:
/// 0.5).
/// @throws std::invalid_argument for an empty list.
double Quantile(std::vector<double> values, double fraction);

/// Median of the steps from one value to the next; 0 for fewer than two.
double MedianStep(const std::vector<double>& rising);

/// Median and 95th percentile, or nothing for an empty list.
struct Spread {
  double median = 0.0, p95 = 0.0;
};
std::optional<Spread> SpreadOf(const std::vector<double>& values);

}  // namespace eval
