#include "app/suite/suite_gate.h"

#include <algorithm>
#include <fstream>

namespace app {
namespace {

constexpr const char* kUnknown = "unknown";

}  // namespace

std::string ProcessorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
      return line.substr(colon + 2);
  }
  return kUnknown;
}

bool IsSameProcessor(const std::string& one, const std::string& other) {
  return one == other && one != kUnknown;
}

std::string PlanText(const SuiteFile& suite) {
  const auto text = [](const std::optional<int>& number) {
    return number ? std::to_string(*number) : "own";
  };
  return text(suite.frames) + " frames, " + text(suite.width) + " x " + text(suite.height);
}

eval::GateCases GatedCases(const SuiteFile& suite, const std::vector<SuiteCase>& cases,
                           const std::map<std::string, ResultRow>& rows) {
  eval::GateCases gated;
  for (const SuiteCase& one : cases) {
    const std::vector<std::string>& variants = suite.gated_variants;
    const bool wanted = variants.empty() || std::find(variants.begin(), variants.end(),
                                                      one.variant) != variants.end();
    const auto row = rows.find(one.key);
    if (!wanted || row == rows.end()) continue;
    const CaseResult& result = row->second.result;
    eval::Figures all = result.figures;
    if (suite.gate.times) all.insert(result.times.begin(), result.times.end());
    gated[one.key] = {result.status == CaseStatus::kFinished, eval::FiguresForGate(all),
                      one.setup_sha256};
  }
  return gated;
}

int LooksOf(const SuiteSeeds& seeds) {
  int looks = 1;
  for (int count = seeds.count; count < seeds.max_count;
       count = std::min(2 * count, seeds.max_count)) {
    ++looks;
  }
  return looks;
}

}  // namespace app
