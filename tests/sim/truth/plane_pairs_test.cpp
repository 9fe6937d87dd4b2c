#include "sim/truth/plane_pairs.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/shapes/planes.h"
#include "sim/truth/truth_json.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

constexpr double kRoundOff = 1e-9;

/// The pair of the upper faces of two objects.
std::optional<PlanePair> Tops(const Scene& scene, int object_a, int object_b) {
  const auto planes = ScenePlanes(scene);
  const auto top = [&](int object) {
    return std::find_if(planes.begin(), planes.end(),
                        [&](const auto& plane) {
                          return plane.object == object && plane.face == Face::kPlusZ;
                        })
        ->id;
  };
  for (const PlanePair& pair : PlanePairs(scene, ScenePlanes(scene))) {
    if (pair.a == top(object_a) && pair.b == top(object_b)) return pair;
  }
  return std::nullopt;
}

Scene TwoBoards(double gap_m, double step_m, double tilt_rad) {
  Scene scene;
  scene.objects = {
      BoxObject(1, "box", Role::kRegular, {0, 0, 0}, {0.2, 0.2, 0.02}),
      BoxObject(2, "box", Role::kRegular, {0.2 + gap_m, 0, step_m}, {0.2, 0.2, 0.02})};
  scene.objects[1].q_wo = Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitY());
  return scene;
}

TEST(PlanePairs, MeasureStepAndGapOfTwoBoardsSideBySide) {
  const auto pair = Tops(TwoBoards(0.03, 0.005, 0), 1, 2);
  ASSERT_TRUE(pair.has_value());
  EXPECT_NEAR(pair->step_mm, 5, kRoundOff);
  EXPECT_NEAR(pair->lateral_gap_mm, 30, kRoundOff);
  EXPECT_NEAR(pair->angle_deg, 0, kRoundOff);
  EXPECT_NEAR(pair->step_sigmas, 5 / 1.884, kRoundOff);  // 1.2 + 1.9 x 0.36 mm
}

TEST(PlanePairs, SignTheStepFromTheFirstToTheSecond) {
  EXPECT_NEAR(Tops(TwoBoards(0.03, -0.005, 0), 1, 2)->step_mm, -5, kRoundOff);
}

TEST(PlanePairs, MeasureTheStepAlongTheFirstNormal) {
  // The second top, tilted by ten degrees, comes nearest with the lower end of its slope.
  const double tilt = 10 * M_PI / 180;
  const auto pair = Tops(TwoBoards(0.03, 0.005, tilt), 1, 2);
  ASSERT_TRUE(pair.has_value());
  // Corner (-0.1, 0.01) of the turned box, from its middle at the height of 5 mm.
  const double up_m = 0.005 + 0.1 * std::sin(tilt) + 0.01 * std::cos(tilt);
  EXPECT_NEAR(pair->step_mm, 1000 * (up_m - 0.01), kRoundOff);
}

TEST(PlanePairs, SayThatABookOnADeskOverlapsIt) {
  const auto pair = Tops(SmallDesk(), 3, 4);
  ASSERT_TRUE(pair.has_value());
  EXPECT_EQ(pair->lateral_gap_mm, 0);
  EXPECT_NEAR(pair->step_mm, 30, kRoundOff);
}

TEST(PlanePairs, MeasureTheAngle) {
  const auto pair = Tops(TwoBoards(0.03, 0.0, 10 * M_PI / 180), 1, 2);
  ASSERT_TRUE(pair.has_value());
  EXPECT_NEAR(pair->angle_deg, 10, kRoundOff);
}

TEST(PlanePairs, LeaveOutWhatIsFarSteepOrNotScored) {
  EXPECT_FALSE(Tops(TwoBoards(0.11, 0, 0), 1, 2).has_value());
  EXPECT_TRUE(Tops(TwoBoards(0.09, 0, 0), 1, 2).has_value());
  EXPECT_FALSE(Tops(TwoBoards(0.03, 0, 16 * M_PI / 180), 1, 2).has_value());
  Scene unscored = TwoBoards(0.03, 0, 0);
  unscored.objects[1].role = Role::kOther;
  EXPECT_FALSE(Tops(unscored, 1, 2).has_value());
}

/// A square frame in z = 0, 0.4 m wide with a hole of 0.2 m, in four pieces.
ScenePlane FrameInPieces() {
  ScenePlane frame;
  frame.id = frame.object = 1;
  const double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const auto corner = [&](int i, double half_m) {
    return Eigen::Vector3d(half_m * corners[i % 4][0], half_m * corners[i % 4][1], 0);
  };
  frame.holes_w.emplace_back();
  for (int i = 0; i < 4; ++i) {
    frame.vertices_w.push_back(corner(i, 0.2));
    frame.holes_w[0].push_back(corner(4 - i, 0.1));
    frame.pieces_w.push_back(
        {corner(i, 0.2), corner(i + 1, 0.2), corner(i + 1, 0.1), corner(i, 0.1)});
  }
  return frame;
}

TEST(PlanePairs, MeasureTheGapToTheNearestOfAFacesPieces) {
  Scene scene;
  scene.objects = {BoxObject(1, "box", Role::kRegular, {0, 0, 0}, {0.4, 0.4, 0.02}),
                   BoxObject(2, "box", Role::kRegular, {0, 0, 0}, {0.1, 0.1, 0.02})};
  const ScenePlane frame = FrameInPieces();
  // A plate of 0.1 m in the hole, 10 mm from one side after the other and tilted about that side.
  for (int side = 0; side < 4; ++side) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(side * M_PI / 2, Eigen::Vector3d::UnitZ()));
    const double tilt = 5 * M_PI / 180;
    const Eigen::Vector3d along = turn * Eigen::Vector3d(0, 1, 0);
    const Eigen::Vector3d inward = turn * Eigen::Vector3d(-std::cos(tilt), 0, std::sin(tilt));
    const Eigen::Vector3d rim = turn * Eigen::Vector3d(0.09, 0, 0.003);
    ScenePlane plate;
    plate.id = plate.object = 2;
    plate.vertices_w = {rim - 0.05 * along, rim + 0.05 * along,
                        rim + 0.05 * along + 0.1 * inward, rim - 0.05 * along + 0.1 * inward};
    plate.n_w = along.cross(inward);
    plate.d = -plate.n_w.dot(rim);
    const auto pairs = PlanePairs(scene, {frame, plate});
    ASSERT_EQ(pairs.size(), 1u) << side;
    EXPECT_NEAR(pairs[0].lateral_gap_mm, 10, kRoundOff) << side;
    EXPECT_NEAR(pairs[0].step_mm, 3, kRoundOff) << side;
  }
}

TEST(PlanePairs, AreListedInTheSceneTruth) {
  const Scene scene = TwoBoards(0.03, 0.005, 0);
  const auto json = nlohmann::json::parse(SceneTruthJson(scene, ScenePlanes(scene)));
  ASSERT_EQ(json["pairs"].size(), PlanePairs(scene, ScenePlanes(scene)).size());
  EXPECT_EQ(json["pairs"][0]["a"], PlanePairs(scene, ScenePlanes(scene))[0].a);
}

TEST(PlanePairs, AreListedWithTheSignOfTheirStep) {
  for (const double step_mm : {5.0, -5.0}) {
    const Scene scene = TwoBoards(0.03, step_mm / 1000, 0);
    const auto tops = Tops(scene, 1, 2);
    ASSERT_TRUE(tops.has_value());
    int listed = 0;
    const auto json = nlohmann::json::parse(SceneTruthJson(scene, ScenePlanes(scene)));
    for (const auto& pair : json["pairs"]) {
      if (pair["a"] != tops->a || pair["b"] != tops->b) continue;
      ++listed;
      EXPECT_NEAR(pair["step_mm"].get<double>(), step_mm, kRoundOff);
      EXPECT_NEAR(pair["step_sigmas"].get<double>(), 5 / 1.884, kRoundOff);  // has no sign
    }
    EXPECT_EQ(listed, 1);
  }
}

}  // namespace
}  // namespace sim
