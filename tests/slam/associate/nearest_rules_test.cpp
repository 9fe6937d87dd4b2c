#include "slam/associate/nearest_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace slam {
namespace {

constexpr double kDegree = M_PI / 180;
const Pose kHere{};  // the camera is the world

/// A board seen head-on from one metre.
FramePlane Board() {
  FramePlane plane;
  plane.pi_c = {-Eigen::Vector3d::UnitZ(), 1.0};
  plane.centroid_c = {0, 0, 1};
  return plane;
}

/// A landmark of three points, turned about its first by an angle; its outline is elsewhere.
MapPlane Landmark(const Eigen::Vector3d& first_w, double angle_rad) {
  MapPlane m;
  const Eigen::Matrix3d turn = ExpSo3({0, angle_rad, 0});
  m.pi_w.n = turn * -Eigen::Vector3d::UnitZ();
  m.pi_w.d = -m.pi_w.n.dot(first_w);
  for (const double x : {0.0, 0.1, 0.2})
    m.points_w.push_back(first_w + turn * Eigen::Vector3d(x, 0, 0));
  m.hull_w = {first_w + Eigen::Vector3d(0, 0, -0.1)};
  return m;
}

Result<double, PairRefusal> Ask(const MapPlane& m, AssociationRule rule) {
  return TestNearness(Board(), m, kHere, rule, {});
}

TEST(NearestRules, TakeAnAngleUpToThePeersBound) {
  const Eigen::Vector3d on_board(0, 0, 1);
  const std::vector<std::pair<AssociationRule, double>> bounds = {
      {AssociationRule::kManhattanSlam, std::acos(0.985)},
      {AssociationRule::kPlanarSlam, std::acos(0.86)},
      {AssociationRule::kSpSlam, std::acos(0.8)}};
  for (const auto& [rule, bound_rad] : bounds) {
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(Ask(Landmark(on_board, sign * (bound_rad - 0.1 * kDegree)), rule));
      const auto beyond = Ask(Landmark(on_board, sign * (bound_rad + 0.1 * kDegree)), rule);
      ASSERT_FALSE(beyond);
      EXPECT_EQ(beyond.error(), PairRefusal::kNormalAngle);
    }
  }
}

TEST(NearestRules, ManhattanSlamAloneTellsTheBackFromTheFront) {
  const MapPlane back = Landmark({0, 0, 1}, M_PI);
  EXPECT_FALSE(Ask(back, AssociationRule::kManhattanSlam));
  EXPECT_TRUE(Ask(back, AssociationRule::kPlanarSlam));
  EXPECT_TRUE(Ask(back, AssociationRule::kSpSlam));
}

TEST(NearestRules, MeasureTheNearestPointOfTheCloudOnEitherSide) {
  for (const double side : {-1.0, 1.0}) {
    // Turned by 5 degrees, so that the first point is the nearest or the farthest.
    const MapPlane m = Landmark({0, 0, 1 + side * 0.04}, 5 * kDegree);
    const double farther_m = 0.2 * std::sin(5 * kDegree);
    const auto distance_m = Ask(m, AssociationRule::kManhattanSlam);
    ASSERT_TRUE(distance_m);
    EXPECT_NEAR(distance_m.value(), side < 0 ? 0.04 : 0.04 - farther_m, 1e-12);
  }
}

TEST(NearestRules, TakeADistanceUpToThePeersBound) {
  for (const auto& [rule, bound_m] : {std::pair(AssociationRule::kManhattanSlam, 0.05),
                                      std::pair(AssociationRule::kPlanarSlam, 0.1)}) {
    EXPECT_TRUE(Ask(Landmark({0, 0, 1 - bound_m + 0.001}, 0), rule));
    const auto beyond = Ask(Landmark({0, 0, 1 - bound_m - 0.001}, 0), rule);
    ASSERT_FALSE(beyond);
    EXPECT_EQ(beyond.error(), PairRefusal::kNearestPoint);
  }
}

TEST(NearestRules, SpSlamAsksTheOutlineAlone) {
  // The outline is 10 cm nearer to the camera than the cloud.
  const auto distance_m = Ask(Landmark({0, 0, 1}, 0), AssociationRule::kSpSlam);
  ASSERT_TRUE(distance_m);
  EXPECT_NEAR(distance_m.value(), 0.1, 1e-12);
  EXPECT_TRUE(Ask(Landmark({0, 0, 0.901}, 0), AssociationRule::kSpSlam));
  EXPECT_FALSE(Ask(Landmark({0, 0, 0.899}, 0), AssociationRule::kSpSlam));
}

// The sides of a wide outline are nearer than its corners where the plane crosses it.
TEST(NearestRules, SpSlamMeasuresTheOutlineBetweenItsCorners) {
  MapPlane m = Landmark({0, 0, 1}, 30 * kDegree);
  const Eigen::Matrix3d turn = ExpSo3({0, 30 * kDegree, 0});
  m.hull_w.clear();
  for (const auto& [x, y] :
       {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
    m.hull_w.push_back(Eigen::Vector3d(0, 0, 1) + turn * Eigen::Vector3d(x, y, 0));
  const auto distance_m = Ask(m, AssociationRule::kSpSlam);
  ASSERT_TRUE(distance_m);
  EXPECT_EQ(distance_m.value(), 0.0);
}

TEST(NearestRules, ALandmarkWithoutPointsIsNearNothing) {
  MapPlane m = Landmark({0, 0, 1}, 0);
  m.points_w.clear();
  m.hull_w.clear();
  EXPECT_FALSE(Ask(m, AssociationRule::kManhattanSlam));
  EXPECT_FALSE(Ask(m, AssociationRule::kSpSlam));
}

TEST(NearestRules, LookFromWhereTheCameraStands) {
  // The same board as a camera sees it that is turned and elsewhere.
  const Pose T_cw{ExpSo3({0.3, -0.2, 0.1}), {0.2, -0.1, 0.4}};
  const MapPlane m = Landmark({0, 0, 0.97}, 0);
  FramePlane seen = Board();
  seen.pi_c = Transform(T_cw, seen.pi_c);
  const auto distance_m = TestNearness(seen, m, T_cw, AssociationRule::kManhattanSlam, {});
  ASSERT_TRUE(distance_m);
  EXPECT_NEAR(distance_m.value(), 0.03, 1e-12);
}

}  // namespace
}  // namespace slam
