// Every figure that evo 1.36.5 gave for real and synthetic trajectories, from the files it
// read.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

#include "eval/trajectory/compare_trajectories.h"
#include "eval/trajectory/match_stamps.h"
#include "io/json_field.h"
#include "tests/support/shared_data.h"

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

/// What is true of the matched stamps, pair by pair.
void ExpectPairs(const PoseFile& estimate, const PoseFile& truth, const nlohmann::json& files) {
  double sum_s = 0.0, max_s = 0.0;
  std::map<std::size_t, int> truth_used, estimate_used;
  const auto matches = MatchNearest(truth.poses, estimate.poses);
  for (const StampMatch& match : matches) {
    const double dt_s =
        std::abs(truth.poses[match.truth].stamp_s - estimate.poses[match.estimate].stamp_s);
    sum_s += dt_s;
    max_s = std::max(max_s, dt_s);
    ++truth_used[match.truth];
    ++estimate_used[match.estimate];
  }
  const auto again = [](const std::map<std::size_t, int>& used) {
    return std::count_if(used.begin(), used.end(), [](const auto& u) { return u.second > 1; });
  };
  EXPECT_EQ(again(truth_used), files["ref_indices_used_more_than_once"].get<int>());
  EXPECT_EQ(again(estimate_used), files["est_indices_used_more_than_once"].get<int>());
  const double max_expected = files["max_abs_dt"], mean_expected = files["mean_abs_dt"];
  EXPECT_NEAR(max_s, max_expected, kRelative * max_expected + kFloor);
  EXPECT_NEAR(sum_s / double(matches.size()), mean_expected,
              kRelative * mean_expected + kFloor);
  // A file matched with itself is matched whole.
  for (const auto& [file, key] :
       {std::pair{&estimate, "est_path_length_full"}, {&truth, "ref_path_length_full"}}) {
    const double expected = files[key];
    EXPECT_NEAR(CompareTrajectories(*file, *file, {}).path_m, expected, kRelative * expected)
        << key;
  }
}

class GoldenEvo : public ::testing::TestWithParam<const char*> {};

TEST_P(GoldenEvo, AgreesOnEveryAbsoluteAndRelativeError) {
  const std::filesystem::path folder = test_support::SharedFolder() / "golden" / GetParam();
  SKIP_WITHOUT(folder);
  const nlohmann::json golden = io::ReadJson(folder / "evo_golden.json");
  std::map<std::string, std::pair<PoseFile, PoseFile>> cases;
  for (const auto& [name, files] : golden["matches"].items()) {
    SCOPED_TRACE(name);
    const auto read = [&, &match = files](const char* key) {
      return ReadPoseFile(folder / "data" / match[key].get<std::string>());
    };
    cases[name] = {read("est"), read("ref")};
    ExpectMatch(CompareTrajectories(cases[name].first, cases[name].second, {}), files);
    ExpectPairs(cases[name].first, cases[name].second, files);
  }
  for (const char* metric : {"ape", "rpe"}) {
    ASSERT_FALSE(golden[metric].empty()) << metric;
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
  const std::filesystem::path file = test_support::SharedFolder() / "golden/umeyama.json";
  SKIP_WITHOUT(file);
  const auto golden = io::ReadJson(file);
  ASSERT_FALSE(golden["cases"].empty());
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
      double sum2 = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        const Eigen::Vector3d there = ours->T_gw.R * (ours->scale * x[i]) + ours->T_gw.t;
        sum2 += (y[i] - there).squaredNorm();
      }
      EXPECT_NEAR(std::sqrt(sum2 / double(x.size())), expected["rmse"].get<double>(), 1e-12);
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
