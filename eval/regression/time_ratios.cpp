#include "eval/regression/time_ratios.h"

#include <algorithm>
#include <cstring>

namespace eval {
namespace {

constexpr const char* kTimeRatio = "/time_ratio/";
constexpr const char* kPlainPass = "orb";
constexpr const char* kPlainPassOver = "epi";
/// Measured on a machine with four times the work that it has cores for: ratios of the medians of equal
/// runs spread by 8 to 17 %, of the quantile 0.1 by 5 % where a module takes a millisecond.
constexpr double kUndisturbedShare = 0.1;

/// Time of the module in frames that nothing held up, ms; nothing when it never ran.
std::optional<double> UndisturbedTime(const Timing& timing, const std::string& module) {
  const auto column = std::find(timing.modules.begin(), timing.modules.end(), module);
  if (column == timing.modules.end()) return std::nullopt;
  const auto at = static_cast<std::size_t>(column - timing.modules.begin());
  std::vector<double> times;
  for (const std::vector<double>& row : timing.rows_ms) {
    if (row[at] > 0.0) times.push_back(row[at]);  // not in frames in which it had nothing to do
  }
  if (times.empty()) return std::nullopt;
  const auto place =
      times.begin() +
      static_cast<std::ptrdiff_t>(kUndisturbedShare * static_cast<double>(times.size() - 1));
  std::nth_element(times.begin(), place, times.end());
  return *place;
}

}  // namespace

Figures TimeRatios(const Timing& timing) {
  Figures ratios;
  for (const GatedMetric& metric : GatedMetrics()) {
    if (metric.kind != MetricKind::kTime) continue;
    const std::string module = metric.figure + std::strlen(kTimeRatio);
    const auto time = UndisturbedTime(timing, module);
    const auto plain =
        UndisturbedTime(timing, module == kPlainPass ? kPlainPassOver : kPlainPass);
    ratios[metric.figure] = plain && time ? std::optional(*time / *plain) : std::nullopt;
  }
  return ratios;
}

}  // namespace eval
