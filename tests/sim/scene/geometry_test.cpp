#include "sim/scene/geometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/angle.h"

namespace sim {
namespace {

constexpr double kRoundOff_m = 1e-12;

Object UnitBox(const Eigen::Vector3d& center_w, const Eigen::Vector3d& rpy_deg = {0, 0, 0}) {
  Object box;
  box.center_w = center_w;
  box.q_wo = QuaternionFromRpyDeg(rpy_deg);
  return box;
}

TEST(OverlapDepth, IsTheShiftThatSeparatesTwoUprightBoxes) {
  EXPECT_NEAR(OverlapDepth(UnitBox({0, 0, 0}), UnitBox({0.9, 0.2, 0})), 0.1, kRoundOff_m);
  EXPECT_NEAR(OverlapDepth(UnitBox({0, 0, 0}), UnitBox({1, 0, 0})), 0, kRoundOff_m);
  EXPECT_NEAR(OverlapDepth(UnitBox({0, 0, 0}), UnitBox({1.3, 0, 0})), -0.3, kRoundOff_m);
}

TEST(OverlapDepth, SeesTheCornerOfATurnedBox) {
  const double half_diagonal = std::sqrt(0.5);
  const Object turned = UnitBox({0.5 + half_diagonal - 0.05, 0, 0}, {0, 0, 45});
  EXPECT_NEAR(OverlapDepth(UnitBox({0, 0, 0}), turned), 0.05, kRoundOff_m);
}

// Edge against edge: no face normal of either box separates these two.
TEST(OverlapDepth, SeparatesCrossedEdgesByTheProductOfTheEdges) {
  const Object below = UnitBox({0, 0, 0}, {45, 0, 0});
  const Object above = UnitBox({0, 0, 2 * std::sqrt(0.5) + 0.01}, {0, 45, 0});
  EXPECT_NEAR(OverlapDepth(below, above), -0.01, kRoundOff_m);
}

TEST(DistanceToBox, IsNegativeInsideAndEuclideanOutside) {
  const Object box = UnitBox({1, 2, 3}, {0, 0, 90});
  EXPECT_NEAR(DistanceToBox(box, {1, 2, 3}), -0.5, kRoundOff_m);
  EXPECT_NEAR(DistanceToBox(box, {1, 2, 4}), 0.5, kRoundOff_m);
  EXPECT_NEAR(DistanceToBox(box, {1.5 + 3, 2.5 + 4, 3}), 5, kRoundOff_m);
}

TEST(Corners, AreTheEightOfTheTurnedBox) {
  Object box = UnitBox({0, 0, 0}, {0, 0, 90});
  box.size = {2, 4, 6};
  EXPECT_LT((Corners(box)[7] - Eigen::Vector3d(-2, 1, 3)).norm(), kRoundOff_m);
  EXPECT_LT((Corners(box)[0] - Eigen::Vector3d(2, -1, -3)).norm(), kRoundOff_m);
}

TEST(ObjectAt, TurnsAboutTheWorldsUprightWhateverTheObjectsOwnRotation) {
  Object leaning = UnitBox({0, 0, 0}, {30, 0, 0});
  leaning.way = {{0, {0, 0, 0}, 0}, {2, {1, 0, 0}, 180}};
  const Pose half_way = ObjectPoseAt(leaning, 1.0);
  EXPECT_NEAR(half_way.t.x(), 0.5, kRoundOff_m);
  // Its own z leans back, towards -y; a quarter turn later towards +x.
  const Eigen::Vector3d up_w = half_way.R.col(2);
  EXPECT_LT((up_w - Eigen::Vector3d(0.5, 0, std::cos(DegToRad(30)))).norm(), kRoundOff_m);
}

TEST(MomentsOf, AreNoFurtherApartThanAStepHoweverTheObjectTurns) {
  constexpr double kStep_m = 0.02;
  Object bar = UnitBox({0, 0, 1}, {0, 20, 0});
  bar.size = {1, 0.2, 0.1};
  // It turns on the spot, turns back as it goes, and goes straight.
  bar.way = {
      {0, {0, 0, 1}, 0}, {1, {0, 0, 1}, 180}, {2, {0.1, 0, 1}, 90}, {5, {0.4, 0, 1}, 90}};
  const std::vector<double> moments = MomentsOf(bar, kStep_m);
  EXPECT_EQ(moments.front(), 0);
  EXPECT_EQ(moments.back(), 5);
  for (std::size_t i = 1; i < moments.size(); ++i) {
    const auto before = Corners(ObjectAt(bar, moments[i - 1]));
    const auto after = Corners(ObjectAt(bar, moments[i]));
    for (std::size_t k = 0; k < 8; ++k) {
      ASSERT_LE((after[k] - before[k]).norm(), kStep_m + kRoundOff_m) << moments[i] << " s";
    }
  }
}

}  // namespace
}  // namespace sim
