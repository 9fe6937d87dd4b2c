#include "app/suite/repeated_times.h"

#include <utility>

#include "eval/trajectory/statistics.h"
#include "io/output_folder.h"

namespace app {
namespace {

// Measured over 31 runs of one program: the ratio of a module wanders by 1.1 % (standard
// deviation) from run to run, half of the time together for minutes. The median of five halves it.
constexpr int kTimeRuns = 5;
constexpr const char* kTimesFolder = "times";
constexpr const char* kRatioGroup = "/time_ratio/";

}  // namespace

std::optional<std::map<std::string, ResultRow>> MeasureTimesAgain(
    const std::vector<SuiteCase>& cases, const SuiteRunOptions& options,
    std::map<std::string, ResultRow> rows) {
  std::vector<std::map<std::string, ResultRow>> runs;
  for (int run = 2; run <= kTimeRuns; ++run) {
    const auto folder = options.folder / kTimesFolder / std::to_string(run);
    io::MakeFolder(folder);
    Results again(folder);
    if (RunCases(cases, options, again)) return std::nullopt;
    runs.push_back(again.Rows());
  }
  for (const SuiteCase& one : cases) {
    for (auto& [name, value] : rows.at(one.key).result.times) {
      if (!value || !name.starts_with(kRatioGroup)) continue;
      std::vector<double> values{*value};
      for (const auto& run : runs) {
        const eval::Figures& times = run.at(one.key).result.times;
        const auto found = times.find(name);
        if (found != times.end() && found->second) values.push_back(*found->second);
      }
      value = eval::Quantile(std::move(values), 0.5);
    }
  }
  return rows;
}

}  // namespace app
