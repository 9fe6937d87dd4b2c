#include "eval/planes/map_score.h"

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <vector>

namespace eval {
namespace {

constexpr int kTabletop = 7;

/// Corners of a level square about the origin.
std::vector<Eigen::Vector3d> SquareOfHalf(double half_m) {
  return {
      {-half_m, -half_m, 0}, {half_m, -half_m, 0}, {half_m, half_m, 0}, {-half_m, half_m, 0}};
}

SceneTruth SceneOfTabletop() {
  SceneTruth scene;
  TruthPlane& top = scene.planes.emplace_back();
  top.id = kTabletop;
  top.scored = true;
  top.area_m2 = 1.0;
  top.vertices_g = SquareOfHalf(0.5);
  return scene;
}

RunMapPlane SquareOnTheTabletop(int id, double half_m) {
  RunMapPlane plane;
  plane.id = id;
  plane.vertices_w = plane.hull_w = SquareOfHalf(half_m);
  return plane;
}

// The small one lies inside the large one, so that the large one is all that both cover.
TEST(ScoreMap, ExplainsByTheLargerOfTwoDuplicatesWhicheverWasSeenMore) {
  const SceneTruth scene = SceneOfTabletop();
  const std::optional<Alignment> gauge = Alignment{};
  for (const int large : {1, 2}) {
    const std::vector<RunMapPlane> map = {SquareOnTheTabletop(1, large == 1 ? 0.4 : 0.1),
                                          SquareOnTheTabletop(2, large == 2 ? 0.4 : 0.1)};
    const std::vector<AssociationRecord> thrice_the_first = {
        {0, kTabletop, 1}, {1, kTabletop, 1}, {2, kTabletop, 1}, {2, kTabletop, 2}};
    const MapScore score = ScoreMap(map, scene, gauge, thrice_the_first, {kTabletop});
    EXPECT_EQ(score.duplicates, 1);
    ASSERT_TRUE(score.area_explained.has_value());
    EXPECT_NEAR(*score.area_explained, 0.8 * 0.8, 1e-12) << "the large one has id " << large;
  }
}

// A covariance of (n, d) speaks of the world's origin, and the error is asked at the surface.
TEST(ScoreMap, HoldsHeightAndSlopesOfAPlaneToWhatTheRunTellsOfThem) {
  constexpr double kSigma_m = 0.001, kSigma_rad = 0.01;
  constexpr double kHigh_m = 0.003, kTilt_rad = 0.02;  // three and two standard deviations
  const Eigen::Vector3d middle(3.0, -2.0, 0.7);
  RunMapPlane plane = SquareOnTheTabletop(1, 0.4);
  for (auto* points : {&plane.vertices_w, &plane.hull_w}) {
    for (Eigen::Vector3d& p : *points) p += middle + kHigh_m * Eigen::Vector3d::UnitZ();
  }
  plane.pi_w.n = Eigen::Vector3d(0.0, kTilt_rad, 1.0).normalized();
  plane.pi_w.d = -plane.pi_w.n.dot(middle + kHigh_m * Eigen::Vector3d::UnitZ());
  // A step along the normal, and turns about two axes through the middle.
  Eigen::Matrix<double, 4, 3> parts = Eigen::Matrix<double, 4, 3>::Zero();
  parts(3, 0) = kSigma_m;
  for (int axis = 0; axis < 2; ++axis) {
    parts(axis, axis + 1) = kSigma_rad;
    parts(3, axis + 1) = -kSigma_rad * middle[axis];
  }
  plane.covariance = parts * parts.transpose();
  const Eigen::Matrix3d R(Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 2, 2) / 3));
  for (const Pose& T_gw : {Pose{}, Pose{R, {-5, 1, 4}}}) {
    Alignment gauge;
    gauge.T_gw = T_gw;
    SceneTruth scene = SceneOfTabletop();
    for (Eigen::Vector3d& p : scene.planes[0].vertices_g) p = T_gw * (middle + p);
    scene.planes[0].pi_g = Transform(T_gw, {Eigen::Vector3d::UnitZ(), -middle.z()});
    const MapScore score = ScoreMap({plane}, scene, gauge, {{0, kTabletop, 1}}, {kTabletop});
    ASSERT_TRUE(score.claims.has_value());
    EXPECT_EQ(score.claims->count, 1u);
    EXPECT_NEAR(score.claims->nees.mean, 9.0 + 4.0, 0.02);
    EXPECT_EQ(score.claims->nees.above, 1.0);
    EXPECT_EQ(score.claims->silent, 0u);
  }
}

TEST(ScoreMap, SaysNothingOfWhatIsToldWhereTheRunTellsNothing) {
  const SceneTruth scene = SceneOfTabletop();
  const MapScore score = ScoreMap({SquareOnTheTabletop(1, 0.4)}, scene, Alignment{},
                                  {{0, kTabletop, 1}}, {kTabletop});
  EXPECT_EQ(score.matched, 1);
  EXPECT_FALSE(score.claims.has_value());
}

}  // namespace
}  // namespace eval
