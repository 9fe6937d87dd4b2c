#include "eval/report/trajectory_report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <sstream>

namespace eval {
namespace {

using ::testing::ElementsAre;

/// A path, and one that has turned by a degree a second more.
ComparedTrajectory Drifting() {
  PoseFile truth, estimate;
  for (int i = 0; i < 30; ++i) {
    const double t = i;
    Pose T_wc;
    T_wc.t = {0.1 * t, 0.02 * t * t, 0.3 * std::sin(t)};
    truth.poses.push_back({t, T_wc});
    T_wc.R = Eigen::AngleAxisd(t * std::numbers::pi / 180, Eigen::Vector3d::UnitY())
                 .toRotationMatrix();
    T_wc.t += Eigen::Vector3d(0.01 * std::cos(3 * t), 0, 0.002 * t);
    estimate.poses.push_back({t, T_wc});
  }
  return {"a.txt", PoseFileKind::kTum, CompareTrajectories(estimate, truth, {})};
}

TEST(TrajectoriesTable, HasTheFiguresOfTheJsonUnderTheirNames) {
  const ComparedTrajectory one = Drifting();
  const auto json = TrajectoriesJson({one}, "truth.txt", {})["trajectories"][0];
  std::istringstream table(TrajectoriesTable({one}, "truth.txt", {}));
  std::string rules, header, row, word;
  std::getline(table, rules), std::getline(table, header), std::getline(table, row);
  EXPECT_THAT(header, ::testing::MatchesRegex(
                          "file +matched +ATE rmse m +mean +median +std +max +rot deg +"
                          "RPE rmse m +rot deg +pairs +scale"));
  std::vector<std::string> columns;
  for (std::istringstream words(row); words >> word;) columns.push_back(word);
  const auto figure = [&](const char* of, const char* what, const char* which, int digits) {
    return fmt::format("{:.{}f}", json[of][what][which].get<double>(), digits);
  };
  EXPECT_THAT(
      columns,
      ElementsAre("a.txt", "30/30", figure("ape", "trans_m", "rmse", 6),
                  figure("ape", "trans_m", "mean", 6), figure("ape", "trans_m", "median", 6),
                  figure("ape", "trans_m", "std", 6), figure("ape", "trans_m", "max", 6),
                  figure("ape", "rot_deg", "rmse", 4), figure("rpe", "trans_m", "rmse", 6),
                  figure("rpe", "rot_deg", "rmse", 4), "29",
                  fmt::format("{:.4f}", json["scale"].get<double>())));
  EXPECT_NEAR(json["rpe"]["rot_deg"]["rmse"].get<double>(), 1, 1e-9);  // a degree a frame
  EXPECT_GT(json["ape"]["rot_deg"]["rmse"].get<double>(), 5);
}

// Each of the two errors has its own reason: one that is short for pairs may well be aligned.
TEST(TrajectoriesJson, SaysWhyThereIsNoRelativeErrorWhereThereIsAnAbsoluteOne) {
  ComparedTrajectory one = Drifting();
  PoseFile truth, estimate;
  for (int i = 0; i < 5; ++i) {
    Pose T_wc;
    T_wc.t = {0.1 * i, 0.02 * i * i, 0};
    truth.poses.push_back({static_cast<double>(i), T_wc});
    estimate.poses.push_back({static_cast<double>(i), T_wc});
  }
  ComparisonRules rules;
  rules.delta = {100, DeltaUnit::kMetres};
  one.score = CompareTrajectories(estimate, truth, rules);
  const auto json = TrajectoriesJson({one}, "truth.txt", rules)["trajectories"][0];
  EXPECT_TRUE(json["ape"]["trans_m"].is_object());
  EXPECT_TRUE(json["rpe"]["trans_m"].is_null());
  EXPECT_EQ(json["reasons"]["rpe/trans_m"], one.score.no_relative);
  EXPECT_NE(one.score.no_relative, "");
}

TEST(TrajectoriesJson, TellsTheLengthsOfBothPathsAsTheyAreInTheFiles) {
  PoseFile truth, estimate;
  for (int i = 0; i <= 20; ++i) {  // a metre ahead, then one to the side
    Pose T_wc;
    T_wc.t = {0.1 * std::min(i, 10), 0.1 * std::max(i - 10, 0), 0};
    truth.poses.push_back({static_cast<double>(i), T_wc});
    T_wc.t *= 1.25;
    estimate.poses.push_back({static_cast<double>(i), T_wc});
  }
  ComparisonRules rules;
  rules.align = AlignMode::kSim3;
  ComparedTrajectory one{"a.txt", PoseFileKind::kTum, {}};
  one.score = CompareTrajectories(estimate, truth, rules);
  const auto json = TrajectoriesJson({one}, "truth.txt", rules)["trajectories"][0];
  EXPECT_NEAR(json["path_m"].get<double>(), 2.5, 1e-9);
  EXPECT_NEAR(json["true_path_m"].get<double>(), 2.0, 1e-9);
}

}  // namespace
}  // namespace eval
