#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace eval {

/// A figure of metrics.json that is watched over time, and how much worse it may become.
///
/// The suites are deterministic, so any change is a change of the program; the margin is what a
/// harmless change (another processor, a reordered sum) may move, not statistical noise.
struct WatchedMetric {
  const char* pointer;  ///< JSON pointer into metrics.json, "/trajectory/ate_se3/rmse_m"
  bool higher_is_better;
  double relative_margin;  ///< share of the baseline
  double absolute_margin;  ///< in the metric's own unit; the larger of the two margins counts
};

/// The watched figures: coverage, trajectory, association, extraction, vertices, map.
std::span<const WatchedMetric> WatchedMetrics();

/// One figure of one scene that became worse than its baseline allows.
struct Regression {
  std::string scene;
  std::string metric;  ///< JSON pointer
  double baseline = 0.0;
  double now = 0.0;    ///< NaN when the figure is gone
  double limit = 0.0;  ///< the worst value that would still pass
};

/// The watched figures of one metrics.json, as the baseline file stores them: pointer -> value.
/// Figures that the metrics lack are left out.
nlohmann::json WatchedFigures(const nlohmann::json& metrics);

/// Every watched figure of `baseline` (scene -> figures) that `now` (same shape) lacks or has
/// worse. Better figures are no regression. A figure that only `now` has is not compared.
/// @throws std::invalid_argument if a value is not a number.
std::vector<Regression> CompareWithBaseline(const nlohmann::json& baseline,
                                            const nlohmann::json& now);

/// One line: scene, figure, baseline, limit, now.
std::string Describe(const Regression& regression);

}  // namespace eval
