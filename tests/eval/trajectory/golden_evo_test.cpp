// Every figure that evo 1.36.5 gave for real and synthetic trajectories, from the files it
// read.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <map>
#include <numbers>

#include "eval/formats/trajectory.h"
#include "eval/trajectory/alignment.h"
#include "eval/trajectory/match_stamps.h"
#include "eval/trajectory/pose_errors.h"
#include "eval/trajectory/statistics.h"
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

struct Matched {
  std::vector<Pose> estimate, truth;
};

Matched Match(const Trajectory& truth, const Trajectory& estimate) {
  Matched matched;
  for (const StampMatch& m : MatchNearest(truth, estimate)) {
    matched.truth.push_back(truth[m.truth].T_wc);
    matched.estimate.push_back(estimate[m.estimate].T_wc);
  }
  return matched;
}

std::vector<Pose> Align(const Matched& matched, const std::string& how) {
  Alignment alignment;
  if (how == "origin") {
    alignment = AlignOrigin(matched.estimate.front(), matched.truth.front());
  } else if (how != "none") {
    std::vector<Eigen::Vector3d> x, y;
    for (const Pose& p : matched.estimate) x.push_back(p.t);
    for (const Pose& p : matched.truth) y.push_back(p.t);
    alignment = AlignUmeyama(x, y, how == "sim3").value();
  }
  std::vector<Pose> aligned;
  for (const Pose& p : matched.estimate) aligned.push_back(alignment * p);
  return aligned;
}

Relation RelationOf(const std::string& name) {
  if (name == "trans_part") return Relation::kTranslation;
  return name == "angle_deg" ? Relation::kAngleDeg : Relation::kFull;
}

std::vector<PosePair> Pairs(const std::vector<Pose>& poses, const nlohmann::json& row) {
  const PairMode mode = row["all_pairs"].get<bool>() ? PairMode::kAll : PairMode::kConsecutive;
  const std::string delta = row["delta"];
  if (delta == "1f") return PairsByFrames(poses.size(), 1, mode);
  if (delta == "1m") return PairsByPath(poses, 1.0, 0.1, mode);
  const double degree = std::numbers::pi / 180.0;
  return PairsByAngle(poses, 10 * degree, degree, mode);
}

void ExpectFigures(const std::vector<double>& errors, const nlohmann::json& row) {
  const Statistics s = Describe(errors).value();
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

class GoldenEvo : public ::testing::TestWithParam<const char*> {};

TEST_P(GoldenEvo, AgreesOnEveryAbsoluteAndRelativeError) {
  const std::filesystem::path folder = testing::SharedFolder() / "golden" / GetParam();
  SKIP_WITHOUT(folder);
  const nlohmann::json golden = io::ReadJson(folder / "evo_golden.json");
  std::map<std::string, Matched> cases;
  for (const auto& [name, files] : golden["matches"].items()) {
    Folder data(folder / "data");
    const Trajectory truth = ReadTrajectory(data, files["ref"]);
    const Trajectory estimate = ReadTrajectory(data, files["est"]);
    EXPECT_EQ(truth.size(), files["ref_poses"].get<std::size_t>());
    cases[name] = Match(truth, estimate);
    EXPECT_EQ(cases[name].truth.size(), files["matched"].get<std::size_t>()) << name;
  }
  for (const auto& row : golden["ape"]) {
    const Matched& matched = cases.at(row["case"]);
    ExpectFigures(AbsoluteErrors(Align(matched, row["align"]), matched.truth,
                                 RelationOf(row["relation"])),
                  row);
  }
  for (const auto& row : golden["rpe"]) {
    const Matched& matched = cases.at(row["case"]);
    const std::vector<Pose> aligned = Align(matched, row["align"]);
    const std::vector<PosePair> pairs = Pairs(aligned, row);
    ASSERT_EQ(pairs.size(), row["n_pairs"].get<std::size_t>()) << row;
    ExpectFigures(RelativeErrors(aligned, matched.truth, pairs, RelationOf(row["relation"])),
                  row);
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
