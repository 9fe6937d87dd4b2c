#include "app/suite/shrink_case.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/program.h"

namespace app {
namespace {

constexpr const char* kAte = "/trajectory/ate_se3/rmse_m";
constexpr const char* kPrecision = "/association/decision/precision";
constexpr const char* kWrong = "/association/decision/fp";
constexpr const char* kTime = "/time_ratio/da";

TEST(FindWorseFigure, TakesTheOneWithTheMostHarmForWhatMatters) {
  const eval::Figures before{{kAte, 0.010}, {kPrecision, 1.0}, {kWrong, 4}, {kTime, 1.0}};
  // 4.1 times the 5 % that matter, 10 times the 0.01, better, and left out.
  const eval::Figures now{{kAte, 0.0122}, {kPrecision, 0.9}, {kWrong, 3}, {kTime, 9.0}};
  const auto worse = FindWorseFigure(before, now);
  ASSERT_TRUE(worse);
  EXPECT_EQ(worse->figure, kPrecision);
  EXPECT_EQ(worse->before, 1.0);
  EXPECT_EQ(worse->now, 0.9);
}

TEST(FindWorseFigure, FindsNothingWhereNoHarmMattersOrAFigureIsUndefined) {
  const eval::Figures before{{kAte, 0.010}, {kPrecision, 1.0}, {kWrong, std::nullopt}};
  const eval::Figures now{{kAte, 0.0104}, {kPrecision, std::nullopt}, {kWrong, 9}};
  EXPECT_FALSE(FindWorseFigure(before, now));
}

// A sensor file says how depth errs, and the suite what the estimator takes the sensor for.
TEST(ShrinkCase, LeavesASuiteThatFailsForTheEstimatorOfASensorFile) {
  const program::TemporaryFolder folder;
  std::ofstream(folder / "sensor.yaml") << "base: azure\n";
  std::ofstream(folder / "suite.yaml")
      << "format: pas-suite/1\nname: s\nscenes: [{family: plates}]\nframes: 2\n"
         "size_px: [64, 48]\nsensors: [{name: mine, file: sensor.yaml, estimator: azure}]\n";
  std::ofstream(folder / "fake")
      << "#!/bin/sh\ncase \"$*\" in *'--sensor azure '*) kill -SEGV $$;; esac\nexit 1\n";
  program::fs::permissions(folder / "fake", program::fs::perms::owner_all);
  const SuiteProgram fake = ProgramOf(folder / "fake");
  const auto go_on = [] { return false; };
  const SuiteFile suite = ReadSuite(folder / "suite.yaml");
  const std::vector<SuiteCase> cases = PlanCases(suite, 1, {}, fake, folder / "out");
  ASSERT_EQ(cases.size(), 1u);
  const ShrunkCase left = ShrinkCase(cases[0], suite, fake, folder / "out", nullptr, go_on);
  const SuiteFile smaller = ReadSuite(left.suite);
  const std::vector<SuiteCase> again = PlanCases(smaller, 1, {}, fake, folder / "again");
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(RunCase(again[0], fake, smaller.limits, folder / "again", go_on).status,
            CaseStatus::kCrashed);
}

}  // namespace
}  // namespace app
