#include "app/suite/summary.h"

#include <fmt/format.h>

#include "eval/trajectory/statistics.h"

namespace app {
namespace {

struct ArmSummary {
  std::size_t cases = 0, failed = 0;
  std::map<std::string, std::vector<double>> figures;
};

std::string Median(const ArmSummary& arm, const char* figure, double unit) {
  const auto found = arm.figures.find(figure);
  if (found == arm.figures.end()) return "-";
  return fmt::format("{:.3f}", unit * eval::Quantile(found->second, 0.5));
}

std::string Mean(const ArmSummary& arm, const char* figure) {
  const auto found = arm.figures.find(figure);
  if (found == arm.figures.end()) return "-";
  double sum = 0.0;
  for (const double value : found->second) sum += value;
  return fmt::format("{:.4f}", sum / static_cast<double>(found->second.size()));
}

std::string ShareLine(const eval::Figures& seconds) {
  double sum = 0.0;
  for (const auto& [name, value] : seconds) sum += value.value_or(0.0);
  if (!(sum > 0.0)) return "";
  const auto part = [&](const char* name) {
    const auto found = seconds.find(name);
    return found == seconds.end() ? 0.0 : 100 * found->second.value_or(0.0) / sum;
  };
  return fmt::format(
      "{:.0f} s of work: {:.0f} % rendering and files, {:.0f} % SLAM, {:.0f} % evaluation\n",
      sum, part(kRenderingTime), part(kSlamTime), part(kEvaluationTime));
}

}  // namespace

std::string SuiteSummary(const std::vector<SuiteCase>& cases,
                         const std::map<std::string, ResultRow>& rows) {
  std::map<std::string, ArmSummary> arms;
  eval::Figures seconds;
  std::string failures;
  for (const SuiteCase& one : cases) {
    const auto row = rows.find(one.key);
    if (row == rows.end()) continue;
    const CaseResult& result = row->second.result;
    ArmSummary& arm = arms[eval::ArmOfKey(one.key)];
    ++arm.cases;
    if (result.status != CaseStatus::kFinished) {
      ++arm.failed;
      failures += fmt::format("{}: {}: {}\n  {}\n", NameOf(result.status), one.key,
                              result.message, row->second.command);
    }
    for (const auto& [name, value] : result.figures) {
      if (value) arm.figures[name].push_back(*value);
    }
    for (const char* name : {kRenderingTime, kSlamTime, kEvaluationTime}) {
      const auto found = result.times.find(name);
      if (found == result.times.end()) continue;
      seconds[name] = seconds[name].value_or(0.0) + found->second.value_or(0.0);
    }
  }
  std::string text =
      fmt::format("{:<44} {:>5} {:>6} {:>8} {:>9} {:>9} {:>7} {:>7}\n", "arm", "cases",
                  "failed", "ATE mm", "precision", "recall", "pq", "tracked");
  for (const auto& [name, arm] : arms) {
    text += fmt::format("{:<44} {:>5} {:>6} {:>8} {:>9} {:>9} {:>7} {:>7}\n", name, arm.cases,
                        arm.failed, Median(arm, "/trajectory/ate_se3/rmse_m", 1e3),
                        Mean(arm, "/association/decision/precision"),
                        Mean(arm, "/association/decision/recall"), Mean(arm, "/extraction/pq"),
                        Mean(arm, "/trajectory/tracked_fraction"));
  }
  return text + failures + ShareLine(seconds);
}

}  // namespace app
