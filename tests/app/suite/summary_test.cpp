#include "app/suite/summary.h"

#include <gmock/gmock.h>

namespace app {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

// A mean is over the cases that have the figure, not over all of the arm.
TEST(SuiteSummary, LeavesOutCasesThatFailedOrHaveNoSuchFigure) {
  std::vector<SuiteCase> cases(4);
  std::map<std::string, ResultRow> rows;
  for (int i = 0; i < 4; ++i) {
    SuiteCase& one = cases[static_cast<std::size_t>(i)];
    one.key = "desk-" + std::to_string(i) + "/kinect1/own/full/default";
    rows[one.key].command = "pas suite again";
  }
  const char* precision = "/association/decision/precision";
  const char* ate = "/trajectory/ate_se3/rmse_m";
  rows[cases[0].key].result = {CaseStatus::kFinished, "", {{precision, 0.9}, {ate, 0.001}}, {}};
  rows[cases[1].key].result = {CaseStatus::kFinished, "", {{precision, 0.7}, {ate, 0.004}}, {}};
  rows[cases[2].key].result = {
      CaseStatus::kFinished, "", {{precision, std::nullopt}, {ate, 0.002}}, {}};
  rows[cases[3].key].result = {CaseStatus::kTimedOut, "not done in 600 s", {}, {}};
  const std::string text = SuiteSummary(cases, rows);
  EXPECT_THAT(text, ContainsRegex("kinect1/own/full/default +4 +1 +2.000 +0.8000"));
  EXPECT_THAT(text, HasSubstr("not done in 600 s"));
  EXPECT_THAT(text, HasSubstr("pas suite again"));
}

}  // namespace
}  // namespace app
