#include "eval/trajectory/statistics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eval {

std::optional<Statistics> Describe(const std::vector<double>& errors) {
  if (errors.empty()) return std::nullopt;
  Statistics s;
  s.count = errors.size();
  const double n = static_cast<double>(errors.size());
  double sum = 0.0;
  for (const double e : errors) {
    sum += e;
    s.sse += e * e;
  }
  s.mean = sum / n;
  s.rmse = std::sqrt(s.sse / n);
  double deviations = 0.0;
  for (const double e : errors) deviations += (e - s.mean) * (e - s.mean);
  s.std_dev = std::sqrt(deviations / n);
  s.median = Quantile(errors, 0.5);
  s.min = *std::min_element(errors.begin(), errors.end());
  s.max = *std::max_element(errors.begin(), errors.end());
  return s;
}

double Quantile(std::vector<double> values, double fraction) {
  if (values.empty()) throw std::invalid_argument("Quantile: the list is empty");
  std::sort(values.begin(), values.end());
  const double rank = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double share = rank - static_cast<double>(below);
  return (1.0 - share) * values[below] + share * values[above];
}

double MedianStep(const std::vector<double>& rising) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < rising.size(); ++i) steps.push_back(rising[i] - rising[i - 1]);
  return steps.empty() ? 0.0 : Quantile(steps, 0.5);
}

std::optional<Spread> SpreadOf(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return Spread{Quantile(values, 0.5), Quantile(values, 0.95)};
}

}  // namespace eval
