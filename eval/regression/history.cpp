#include "eval/regression/history.h"

#include <algorithm>
#include <cmath>

#include "eval/trajectory/statistics.h"

namespace eval {
namespace {

constexpr std::size_t kMinBaselines = 3;  // the median of two is no middle
constexpr std::size_t kMaxHistory = 50;   // steps that are kept
constexpr double kSpreads = 3.0;          // standard deviations beyond which a level stands out
constexpr double kSigmaOfMad = 1.4826;    // of a normal distribution

double Median(const std::vector<double>& values) { return Quantile(values, 0.5); }

double StepOf(const PastBaseline& past, const std::string& arm, const std::string& figure) {
  const auto figures = past.harm.find(arm);
  if (figures == past.harm.end()) return 0.0;
  const auto found = figures->second.find(figure);
  return found == figures->second.end() ? 0.0 : found->second;
}

}  // namespace

std::optional<Drift> DriftOf(const std::vector<PastBaseline>& history, const std::string& arm,
                             const GatedMetric& metric, double shift) {
  // Each baseline's level over the first one's, and the steps between them.
  std::vector<double> levels{0.0}, steps;
  for (const PastBaseline& past : history) {
    steps.push_back(StepOf(past, arm, metric.figure));
    levels.push_back(levels.back() + steps.back());
  }
  if (levels.size() < kMinBaselines) return std::nullopt;
  const double harm = levels.back() + shift - Median(levels);
  // Steps add up by chance as the root of their number. Their own spread counts, as a steady drift
  // spreads the levels itself.
  steps.push_back(shift);
  const double middle = Median(steps);
  std::vector<double> deviations;
  for (const double step : steps) deviations.push_back(std::abs(step - middle));
  const double chance = kSpreads * kSigmaOfMad * Median(deviations) *
                        std::sqrt(static_cast<double>(steps.size()));
  if (!(harm > MaxHarm(metric.kind)) || !(harm > chance)) return std::nullopt;
  return Drift{harm, levels.size()};
}

std::vector<PastBaseline> HistoryAfter(const Baseline& before, const GateReport& report) {
  std::vector<PastBaseline> history = before.history;
  history.push_back({before.program, before.reason, {}});
  for (const MetricVerdict& found : report.metrics) {
    if (found.metric.kind == MetricKind::kTime) continue;  // of one machine and one hour
    if (found.pairs < kMinPairs) continue;                 // says nothing
    if (found.verdict != Verdict::kWorse && !found.drift) {
      if (found.shift != 0.0) history.back().harm[found.arm][found.metric.figure] = found.shift;
      continue;
    }
    for (PastBaseline& past : history) {
      const auto figures = past.harm.find(found.arm);
      if (figures != past.harm.end()) figures->second.erase(found.metric.figure);
    }
  }
  if (history.size() > kMaxHistory) history.erase(history.begin());
  return history;
}

}  // namespace eval
