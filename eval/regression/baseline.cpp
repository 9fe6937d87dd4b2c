#include "eval/regression/baseline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace eval {
namespace {

constexpr std::array kWatched = {
    WatchedMetric{"/trajectory/tracked_fraction", true, 0.0, 0.0},
    WatchedMetric{"/trajectory/ate_se3/rmse_m", false, 0.15, 0.0003},
    WatchedMetric{"/association/decision/precision", true, 0.0, 0.02},
    WatchedMetric{"/association/decision/recall", true, 0.0, 0.02},
    WatchedMetric{"/association/pair/precision", true, 0.0, 0.02},
    WatchedMetric{"/association/merged_map_planes", false, 0.0, 0.5},
    WatchedMetric{"/extraction/pq", true, 0.0, 0.02},
    WatchedMetric{"/extraction/normal_deg/median", false, 0.15, 0.02},
    WatchedMetric{"/extraction/offset_mm/median", false, 0.15, 0.05},
    WatchedMetric{"/vertices/precision", true, 0.0, 0.03},
    WatchedMetric{"/vertices/recall", true, 0.0, 0.03},
    WatchedMetric{"/vertices/error_mm/median", false, 0.15, 0.2},
    WatchedMetric{"/map/offset_mm/median", false, 0.2, 0.3},
};

/// The worst value that still passes.
double Limit(const WatchedMetric& metric, double baseline) {
  const double margin =
      std::max(metric.relative_margin * std::abs(baseline), metric.absolute_margin);
  return metric.higher_is_better ? baseline - margin : baseline + margin;
}

double Number(const nlohmann::json& value, const std::string& where) {
  if (!value.is_number())
    throw std::invalid_argument("baseline: " + where + " is not a number");
  return value.get<double>();
}

}  // namespace

std::span<const WatchedMetric> WatchedMetrics() { return kWatched; }

nlohmann::json WatchedFigures(const nlohmann::json& metrics) {
  nlohmann::json figures = nlohmann::json::object();
  for (const WatchedMetric& metric : kWatched) {
    const nlohmann::json::json_pointer pointer(metric.pointer);
    if (metrics.contains(pointer) && metrics.at(pointer).is_number()) {
      figures[metric.pointer] = metrics.at(pointer);
    }
  }
  return figures;
}

std::vector<Regression> CompareWithBaseline(const nlohmann::json& baseline,
                                            const nlohmann::json& now) {
  std::vector<Regression> regressions;
  for (const auto& [scene, figures] : baseline.items()) {
    for (const WatchedMetric& metric : kWatched) {
      if (!figures.contains(metric.pointer)) continue;
      const double before = Number(figures.at(metric.pointer), scene + metric.pointer);
      const double limit = Limit(metric, before);
      double value = std::numeric_limits<double>::quiet_NaN();
      if (now.contains(scene) && now.at(scene).contains(metric.pointer)) {
        value = Number(now.at(scene).at(metric.pointer), scene + metric.pointer);
      }
      const bool passes = metric.higher_is_better ? value >= limit : value <= limit;
      if (!passes) regressions.push_back({scene, metric.pointer, before, value, limit});
    }
  }
  return regressions;
}

std::string Describe(const Regression& regression) {
  std::ostringstream line;
  line << regression.scene << " " << regression.metric << ": " << regression.now
       << ", baseline " << regression.baseline << ", limit " << regression.limit;
  return line.str();
}

}  // namespace eval
