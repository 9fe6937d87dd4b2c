#include "eval/regression/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace eval {
namespace {

constexpr const char* kAteFigure = "/trajectory/ate_se3/rmse_m";
constexpr const char* kPrecisionFigure = "/association/decision/precision";
constexpr const char* kTestedArm = "kinect1/own/full/default";

GateCases CasesWith(double ate_m, double precision) {
  GateCases cases;
  for (int seed = 0; seed < 20; ++seed) {
    const double own = 1 + 0.02 * seed;  // scenes differ
    cases["desk-" + std::to_string(seed) + "/" + kTestedArm] = {
        true, {{kAteFigure, ate_m * own}, {kPrecisionFigure, precision - 0.001 * seed}}, {}};
  }
  return cases;
}

Baseline First() { return {"s", "p", "first", "c", "begun", CasesWith(0.002, 0.99)}; }

/// The baseline after these cases were accepted in its place.
Baseline Accepted(const Baseline& before, const GateCases& now) {
  Baseline after{"s", "p", "next", "c", "why", now};
  after.history = HistoryAfter(before, CompareWithBaseline(before, now, {}));
  return after;
}

std::vector<std::string> Drifted(const Baseline& baseline, const GateCases& now) {
  std::vector<std::string> figures;
  for (const MetricVerdict& found : CompareWithBaseline(baseline, now, {}).metrics) {
    if (found.drift) figures.emplace_back(found.metric.figure);
  }
  return figures;
}

TEST(History, AnErrorThatCreepsIsToldThoughNoStepIsWorse) {
  // Three per cent each time: the gate alone passes all of them.
  Baseline baseline = First();
  double ate_m = 0.002;
  int accepted = 0;
  for (;; ++accepted) {
    ASSERT_LT(accepted, 10);
    ate_m *= 1.03;
    const GateReport report = CompareWithBaseline(baseline, CasesWith(ate_m, 0.99), {});
    EXPECT_TRUE(std::all_of(report.metrics.begin(), report.metrics.end(),
                            [](const auto& m) { return m.verdict == Verdict::kSame; }));
    if (report.AnyWorse()) {
      EXPECT_THAT(GateTable(report),
                  ::testing::HasSubstr("DRIFT     " + std::string(kAteFigure)));
      break;
    }
    baseline = Accepted(baseline, CasesWith(ate_m, 0.99));
  }
  // Two steps were accepted: the median is one step up, and the third is two over it, 6 %.
  EXPECT_EQ(accepted, 2);
}

TEST(History, WhatStaysOrBecomesBetterOrWorseInTurnHasNotDrifted) {
  Baseline same = First(), better = First(), in_turn = First();
  for (int step = 1; step < 8; ++step) {
    const double gain = std::pow(0.97, step), turn = step % 2 == 0 ? 1.0 : 1.03;
    EXPECT_THAT(Drifted(same, CasesWith(0.002, 0.99)), ::testing::IsEmpty());
    EXPECT_THAT(Drifted(better, CasesWith(0.002 * gain, 0.99)), ::testing::IsEmpty());
    EXPECT_THAT(Drifted(in_turn, CasesWith(0.002 * turn, 0.99)), ::testing::IsEmpty());
    same = Accepted(same, CasesWith(0.002, 0.99));
    better = Accepted(better, CasesWith(0.002 * gain, 0.99));
    in_turn = Accepted(in_turn, CasesWith(0.002 * turn, 0.99));
  }
}

TEST(History, AScoreDriftsByDifferencesAndDownwards) {
  Baseline baseline = First();
  for (const double precision : {0.984, 0.978}) {
    EXPECT_THAT(Drifted(baseline, CasesWith(0.002, precision)), ::testing::IsEmpty());
    baseline = Accepted(baseline, CasesWith(0.002, precision));
  }
  EXPECT_THAT(Drifted(baseline, CasesWith(0.002, 0.972)),
              ::testing::ElementsAre(kPrecisionFigure));
  EXPECT_THAT(Drifted(baseline, CasesWith(0.002, 0.980)), ::testing::IsEmpty());
}

TEST(History, BeginsAnewForAFigureWhoseDriftOrLossWasAccepted) {
  for (const double last : {1.03, 1.5}) {  // drifted; worse by itself
    SCOPED_TRACE(last);
    Baseline baseline = First();
    double ate_m = 0.002, precision = 0.99;
    for (const double factor : {1.03, 1.03, last}) {
      ate_m *= factor, precision -= 0.003;
      baseline = Accepted(baseline, CasesWith(ate_m, precision));
    }
    for (const PastBaseline& past : baseline.history) {
      const auto figures = past.harm.find(kTestedArm);
      ASSERT_NE(figures, past.harm.end());
      EXPECT_EQ(figures->second.count(kAteFigure), 0u);
      EXPECT_NEAR(figures->second.at(kPrecisionFigure), 0.003, 1e-9);  // goes on
    }
    EXPECT_THAT(Drifted(baseline, CasesWith(ate_m * 1.03, precision)), ::testing::IsEmpty());
  }
}

TEST(History, TellsWhoseBaselinesTheyWereTheOldestFirst) {
  const Baseline second = Accepted(First(), CasesWith(0.002, 0.99));
  const Baseline third = Accepted(second, CasesWith(0.002, 0.99));
  ASSERT_EQ(third.history.size(), 2u);
  EXPECT_EQ(third.history[0].program, "first");
  EXPECT_EQ(third.history[0].reason, "begun");
  EXPECT_EQ(third.history[1].program, "next");
  EXPECT_TRUE(third.history[1].harm.empty());
}

TEST(History, FewPairsAddNothing) {
  Baseline few = First();
  while (few.cases.size() > kMinPairs - 1) few.cases.erase(few.cases.begin());
  const Baseline after = Accepted(few, CasesWith(0.0021, 0.99));
  EXPECT_TRUE(after.history.at(0).harm.empty());
}

/// How often one look at a figure says that it drifted, when each step is drawn: of 1,000 histories of up to
/// 20 baselines, which begin anew where it does.
double ShareOfLooks(double mean_step, double sigma_step) {
  std::mt19937 random(11);
  std::normal_distribution<double> step(mean_step, sigma_step);
  const GatedMetric ate{kAteFigure, MetricKind::kError};
  int looks = 0, drifts = 0;
  for (int history_number = 0; history_number < 1000; ++history_number) {
    std::vector<PastBaseline> history;
    for (int accepted = 0; accepted < 20; ++accepted) {
      const double shift = step(random);
      const bool drifted = DriftOf(history, kTestedArm, ate, shift).has_value();
      ++looks, drifts += drifted ? 1 : 0;
      if (drifted) history.clear();
      history.emplace_back().harm[kTestedArm][kAteFigure] = drifted ? 0.0 : shift;
    }
  }
  return static_cast<double>(drifts) / looks;
}

TEST(History, StepsByChanceAreHardlyEverDriftAndSteadyOnesAlwaysAre) {
  EXPECT_LT(ShareOfLooks(0.0, 0.01), 0.002);
  EXPECT_LT(ShareOfLooks(0.0, 0.02), 0.01);  // the rule's alpha
  // Two per cent each time are found at the fifth look: four of 20 looks.
  EXPECT_GT(ShareOfLooks(0.02, 0.005), 0.15);
}

TEST(History, SpreadOfTheBaselinesIsNoDrift) {
  // Levels 0, +8, -8, +8, -8 %: one more of +8 % is as the others.
  std::vector<PastBaseline> history(4);
  const double up = std::log(1.08);
  history[0].harm[kTestedArm][kAteFigure] = up;
  for (const std::size_t i : {1u, 3u}) history[i].harm[kTestedArm][kAteFigure] = -2 * up;
  history[2].harm[kTestedArm][kAteFigure] = 2 * up;
  const GatedMetric ate{kAteFigure, MetricKind::kError};
  EXPECT_FALSE(DriftOf(history, kTestedArm, ate, 2 * up));
  const auto drift = DriftOf(history, kTestedArm, ate, 40 * up);
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->harm, 39 * up, 1e-12);  // the median is the first level
  EXPECT_EQ(drift->baselines, 5u);
  EXPECT_FALSE(DriftOf(history, "another arm", ate, 0.0));
}

}  // namespace
}  // namespace eval
