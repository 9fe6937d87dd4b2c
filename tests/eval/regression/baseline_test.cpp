#include "eval/regression/baseline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace eval {
namespace {

using nlohmann::json;

json Metrics() {
  return {{"trajectory", {{"tracked_fraction", 1.0}, {"ate_se3", {{"rmse_m", 0.004}}}}},
          {"association", {{"decision", {{"precision", 0.97}, {"recall", 0.95}}}}}};
}

json Suite(const json& metrics) { return {{"desk", WatchedFigures(metrics)}}; }

TEST(Baseline, ComparesEqualWithItself) {
  EXPECT_TRUE(CompareWithBaseline(Suite(Metrics()), Suite(Metrics())).empty());
}

TEST(Baseline, LeavesOutFiguresThatTheMetricsLack) {
  EXPECT_FALSE(WatchedFigures(Metrics()).contains("/vertices/precision"));
}

TEST(Baseline, ReportsAnErrorThatGrewBeyondItsMarginAndNothingElse) {
  json worse = Metrics();
  worse["trajectory"]["ate_se3"]["rmse_m"] = 0.005;
  const auto found = CompareWithBaseline(Suite(Metrics()), Suite(worse));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].metric, "/trajectory/ate_se3/rmse_m");
  EXPECT_THAT(Describe(found[0]), testing::HasSubstr("desk /trajectory/ate_se3/rmse_m: 0.005"));
}

TEST(Baseline, ReportsAScoreThatFellBeyondItsMargin) {
  json worse = Metrics();
  worse["association"]["decision"]["precision"] = 0.94;
  EXPECT_EQ(CompareWithBaseline(Suite(Metrics()), Suite(worse)).size(), 1u);
}

TEST(Baseline, AcceptsEveryImprovement) {
  json better = Metrics();
  better["trajectory"]["ate_se3"]["rmse_m"] = 0.001;
  better["association"]["decision"]["precision"] = 1.0;
  EXPECT_TRUE(CompareWithBaseline(Suite(Metrics()), Suite(better)).empty());
}

TEST(Baseline, ReportsAFigureThatVanishedAndASceneThatVanished) {
  json gone = Metrics();
  gone.erase("association");
  EXPECT_EQ(CompareWithBaseline(Suite(Metrics()), Suite(gone)).size(), 2u);
  EXPECT_EQ(CompareWithBaseline(Suite(Metrics()), json::object()).size(), 4u);
}

TEST(Baseline, ReportsASingleLostFrame) {
  json worse = Metrics();
  worse["trajectory"]["tracked_fraction"] = 0.989;
  EXPECT_EQ(CompareWithBaseline(Suite(Metrics()), Suite(worse)).size(), 1u);
}

}  // namespace
}  // namespace eval
