// Every figure that evo 1.36.5 gave for real and synthetic trajectories, from the files it
// read.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <map>

#include "eval/trajectory/compare_trajectories.h"
#include "io/json_field.h"
#include "tests/eval/shared_data.h"

namespace eval {
namespace {

// The definitions agree with evo's to 3e-10 relative on its own data; the floor covers figures
// that are round-off themselves (a perfect estimate), at metres and degrees near 1. The angle
// of a rotation that equals the identity to round-off is the square root of nothing: 1e-6 deg.
constexpr double kRelative = 1e-9;
constexpr double kFloor = 1e-11;
constexpr double kAngleFloor_deg = 1e-6;

ComparisonRules RulesOf(const nlohmann::json& row) {
  const std::map<std::string, AlignMode> modes = {{"none", AlignMode::kNone},
                                                  {"origin", AlignMode::kOrigin},
                                                  {"se3", AlignMode::kSe3},
                                                  {"sim3", AlignMode::kSim3}};
  const std::map<std::string, PoseDelta> deltas = {{"1f", {1.0, DeltaUnit::kFrames}},
                                                   {"1m", {1.0, DeltaUnit::kMetres}},
                                                   {"10deg", {10.0, DeltaUnit::kDegrees}}};
  ComparisonRules rules;
  rules.align = modes.at(row["align"]);
  rules.delta = deltas.at(row.value("delta", "1f"));
  rules.pairs = row.value("all_pairs", false) ? PairMode::kAll : PairMode::kConsecutive;
  return rules;
}

void ExpectFigures(const ErrorStatistics& errors, const nlohmann::json& row) {
  const std::map<std::string, std::optional<Statistics>> relations = {
      {"trans_part", errors.translation_m},
      {"angle_deg", errors.rotation_deg},
      {"full", errors.full}};
  const Statistics s = relations.at(row["relation"]).value();
  EXPECT_EQ(s.count, row["n_pairs"].get<std::size_t>()) << row;
  const double floor = row["relation"] == "angle_deg" ? kAngleFloor_deg : kFloor;
  const std::map<std::string, double> ours = {
      {"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median}, {"std", s.std_dev},
      {"min", s.min},   {"max", s.max},   {"sse", s.sse}};
  for (const auto& [key, value] : ours) {
    const double expected = row[key];
    EXPECT_NEAR(value, expected, kRelative * std::abs(expected) + floor)
        << key << " of " << row;
  }
}

void ExpectMatch(const TrajectoryComparison& ours, const nlohmann::json& files) {
  EXPECT_EQ(ours.true_poses, files["ref_poses"].get<std::size_t>());
  EXPECT_EQ(ours.poses, files["est_poses"].get<std::size_t>());
  EXPECT_EQ(ours.matched, files["matched"].get<std::size_t>());
  const std::map<std::string, double> figures = {
      {"est_path_length_matched", ours.path_m},
      {"ref_path_length_matched", ours.true_path_m},
      {"max_gap_between_matched_est_poses_s", ours.max_gap_s}};
  for (const auto& [key, value] : figures) {
    const double expected = files[key];
    EXPECT_NEAR(value, expected, kRelative * expected) << key;
  }
}

class GoldenEvo : public ::testing::TestWithParam<const char*> {};

TEST_P(GoldenEvo, AgreesOnEveryAbsoluteAndRelativeError) {
  const std::filesystem::path folder = testing::SharedFolder() / "golden" / GetParam();
  SKIP_WITHOUT(folder);
  const nlohmann::json golden = io::ReadJson(folder / "evo_golden.json");
  std::map<std::string, std::pair<PoseFile, PoseFile>> cases;
  for (const auto& [name, files] : golden["matches"].items()) {
    SCOPED_TRACE(name);
    const auto read = [&](const char* key) {
      return ReadPoseFile(folder / "data" / files[key].get<std::string>());
    };
    cases[name] = {read("est"), read("ref")};
    ExpectMatch(CompareTrajectories(cases[name].first, cases[name].second, {}), files);
  }
  for (const char* metric : {"ape", "rpe"}) {
    for (const auto& row : golden[metric]) {
      const auto& [estimate, truth] = cases.at(row["case"]);
      const TrajectoryComparison ours = CompareTrajectories(estimate, truth, RulesOf(row));
      ExpectFigures(metric == std::string("ape") ? ours.absolute : ours.relative, row);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(References, GoldenEvo, ::testing::Values("evo", "evo_synthetic"),
                         [](const auto& chosen) { return std::string(chosen.param); });

TEST(GoldenUmeyama, AgreesWhereTheRotationIsDefinedAndRefusesWhereItIsNot) {
  const std::filesystem::path file = testing::SharedFolder() / "golden/umeyama.json";
  SKIP_WITHOUT(file);
  const auto golden = io::ReadJson(file);
  for (const auto& example : golden["cases"]) {
    SCOPED_TRACE(example["name"]);
    std::vector<Eigen::Vector3d> x, y;
    for (const auto& p : example["x_est"]) x.emplace_back(p[0], p[1], p[2]);
    for (const auto& p : example["y_ref"]) y.emplace_back(p[0], p[1], p[2]);
    for (const bool with_scale : {false, true}) {
      const auto ours = AlignUmeyama(x, y, with_scale);
      if (!example["compare_R"].get<bool>()) {
        EXPECT_FALSE(ours.has_value());
        continue;
      }
      ASSERT_TRUE(ours.has_value());
      const auto& expected = example[with_scale ? "sim3" : "se3"];
      EXPECT_NEAR(ours->scale, expected["c"].get<double>(), 1e-12);
      EXPECT_NEAR(ours->T_gw.R.determinant(), 1.0, 1e-12);
      for (std::size_t row = 0; row < 3; ++row) {
        EXPECT_NEAR(ours->T_gw.t[Eigen::Index(row)], expected["t"][row].get<double>(), 1e-11);
        for (std::size_t col = 0; col < 3; ++col) {
          EXPECT_NEAR(ours->T_gw.R(Eigen::Index(row), Eigen::Index(col)),
                      expected["R"][row][col].get<double>(), 1e-11);
        }
      }
    }
  }
}

}  // namespace
}  // namespace eval
