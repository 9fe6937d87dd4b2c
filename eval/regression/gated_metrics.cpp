#include "eval/regression/gated_metrics.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace eval {
namespace {

constexpr std::array kGated = {
    GatedMetric{"/trajectory/ate_se3/rmse_m", MetricKind::kError},
    GatedMetric{"/trajectory/rpe_1s/trans_rmse_m", MetricKind::kError},
    GatedMetric{"/trajectory/rpe_1s/rot_rmse_deg", MetricKind::kError},
    GatedMetric{"/consistency/absolute/silent", MetricKind::kCount},
    GatedMetric{"/association/decision/precision", MetricKind::kScore},
    GatedMetric{"/association/decision/recall", MetricKind::kScore},
    GatedMetric{"/association/decision/fp", MetricKind::kCount},
    GatedMetric{"/association/no_decision/events", MetricKind::kCount},
    GatedMetric{"/association/pair/precision", MetricKind::kScore},
    GatedMetric{"/association/pair/recall", MetricKind::kScore},
    GatedMetric{"/association/merged_map_planes", MetricKind::kCount},
    GatedMetric{"/extraction/pq", MetricKind::kScore},
    GatedMetric{"/extraction/normal_deg/median", MetricKind::kError},
    GatedMetric{"/extraction/offset_mm/median", MetricKind::kError},
    GatedMetric{"/vertices/precision", MetricKind::kScore},
    GatedMetric{"/vertices/recall", MetricKind::kScore},
    GatedMetric{"/vertices/error_mm/median", MetricKind::kError},
    GatedMetric{"/map/normal_deg/median", MetricKind::kError},
    GatedMetric{"/map/offset_mm/median", MetricKind::kError},
    GatedMetric{"/map/area_explained", MetricKind::kScore},
    GatedMetric{"/map/duplicates", MetricKind::kCount},
    GatedMetric{"/map/spurious", MetricKind::kCount},
    GatedMetric{"/time_ratio/orb", MetricKind::kTime},
    GatedMetric{"/time_ratio/epi", MetricKind::kTime},
    GatedMetric{"/time_ratio/pp", MetricKind::kTime},
    GatedMetric{"/time_ratio/da", MetricKind::kTime},
    GatedMetric{"/time_ratio/po", MetricKind::kTime},
    GatedMetric{"/time_ratio/upm", MetricKind::kTime},
};

/// Below every figure's digits; keeps an error of exactly 0 comparable.
constexpr double kMinError = 1e-9;
/// Half a count, so that 0 has a ratio to 1 (Haldane and Anscombe's correction).
constexpr double kHalfCount = 0.5;

constexpr double kMaxErrorRatio = 1.05;  // metrics.md 5.3: 5 % of an error matter
constexpr double kMaxScoreLoss = 0.01;   // likewise: 0.01 of a score
/// Between the smallest slow-down that the gate must find, 5 %, and what the ratio of equal runs wanders
/// by: 1.1 % (standard deviation of 31 runs), 2.9 % at most in medians of five.
constexpr double kMaxTimeRatio = 1.03;

}  // namespace

std::span<const GatedMetric> GatedMetrics() { return kGated; }

double Harm(MetricKind kind, double baseline, double candidate) {
  switch (kind) {
    case MetricKind::kScore:
      return baseline - candidate;
    case MetricKind::kCount:
      return std::log((candidate + kHalfCount) / (baseline + kHalfCount));
    case MetricKind::kError:
    case MetricKind::kTime:
      break;
  }
  return std::log((candidate + kMinError) / (baseline + kMinError));
}

double MaxHarm(MetricKind kind) {
  if (kind == MetricKind::kScore) return kMaxScoreLoss;
  return std::log(kind == MetricKind::kTime ? kMaxTimeRatio : kMaxErrorRatio);
}

std::string HarmText(MetricKind kind, double harm) {
  return kind == MetricKind::kScore ? fmt::format("{:+.4f}", -harm)
                                    : fmt::format("{:+.2f} %", 100 * std::expm1(harm));
}

}  // namespace eval
