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

TEST(ScoreMap, TakesTheErrorsOfTheDuplicateThatWasSeenMost) {
  const SceneTruth scene = SceneOfTabletop();
  for (const int good : {1, 2}) {
    std::vector<RunMapPlane> map = {SquareOnTheTabletop(1, 0.4), SquareOnTheTabletop(2, 0.4)};
    map[good == 1 ? 1 : 0].pi_w.n = Eigen::Vector3d(0, 0.1, 1).normalized();
    const int bad = 3 - good;
    const MapScore score = ScoreMap(
        map, scene, Alignment{},
        {{0, kTabletop, bad}, {1, kTabletop, good}, {2, kTabletop, good}}, {kTabletop});
    EXPECT_EQ(score.matched, 1);
    ASSERT_TRUE(score.normal_deg.has_value());
    EXPECT_NEAR(score.normal_deg->p95, 0.0, 1e-9) << good;
    EXPECT_NEAR(score.offset_mm->p95, 0.0, 1e-9) << good;
  }
}

TEST(ScoreMap, GivesAMapPlaneToWhatMostOfItsObservationsShowAndOfTiesToTheLowerTruth) {
  SceneTruth scene = SceneOfTabletop();
  constexpr int kSheet = kTabletop + 2, kNothing = 0;
  scene.planes.push_back(scene.planes[0]);
  scene.planes[1].id = kSheet;
  scene.planes[1].pi_g.n = -scene.planes[0].pi_g.n;
  const auto matched = [&](const std::vector<int>& truths) {
    std::vector<AssociationRecord> records;
    for (const int truth : truths) records.push_back({0, truth, 1});
    const MapScore score = ScoreMap({SquareOnTheTabletop(1, 0.4)}, scene, Alignment{}, records,
                                    {kTabletop, kSheet});
    EXPECT_EQ(score.matched + score.spurious, 1);
    return score.spurious == 1                   ? kNothing
           : score.normal_deg.value().median < 1 ? kTabletop
                                                 : kSheet;
  };
  EXPECT_EQ(matched({kTabletop, kSheet, kSheet}), kSheet);
  EXPECT_EQ(matched({kSheet, kTabletop}), kTabletop);
  EXPECT_EQ(matched({kNothing, kSheet}), kSheet);
  EXPECT_EQ(matched({kNothing, kNothing, kSheet}), kNothing);
  EXPECT_EQ(matched({}), kNothing);
}

// A covariance of (n, d) speaks of the world's origin, and the error is asked at the surface: of a
// plane that is `x` too high and too steep where x has the covariance C, x^T C^-1 x comes back,
// wherever the run's world lies, however large it is, and whatever goes together with what.
TEST(ScoreMap, HoldsHeightAndSlopesOfAPlaneToWhatTheRunTellsOfThem) {
  const Eigen::Vector3d middle(3.0, -2.0, 0.7), n = Eigen::Vector3d(1, -2, 5).normalized();
  const Eigen::Vector3d p = n.cross(Eigen::Vector3d::UnitX()).normalized(), q = n.cross(p);
  Eigen::Matrix3d root;
  root << 2e-4, 0, 0, 1e-3, 1.5e-3, 0, -5e-4, 8e-4, 1e-3;
  const Eigen::Matrix3d C = root * root.transpose();
  // The step along the normal, and the slopes along p and q, as parts of (n, d).
  Eigen::Matrix<double, 4, 3> parts = Eigen::Matrix<double, 4, 3>::Zero();
  parts(3, 0) = -1.0;
  parts.col(1) << -p, p.dot(middle);
  parts.col(2) << -q, q.dot(middle);
  const Eigen::Matrix3d R(Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 2, 2) / 3));
  for (const Eigen::Vector3d& x :
       {Eigen::Vector3d(4e-4, 2e-3, -3e-3), Eigen::Vector3d(1e-4, 1e-3, 1e-3),
        Eigen::Vector3d(0, -2e-3, 0), Eigen::Vector3d(-1e-3, 0, 0)}) {
    RunMapPlane plane = SquareOnTheTabletop(1, 0.0);
    plane.pi_w.n = (n - x[1] * p - x[2] * q).normalized();
    plane.pi_w.d = -plane.pi_w.n.dot(middle + x[0] * n);
    for (auto* points : {&plane.vertices_w, &plane.hull_w}) {
      *points = {middle + x[0] * n - 0.4 * p, middle + x[0] * n - 0.4 * q,
                 middle + x[0] * n + 0.4 * p, middle + x[0] * n + 0.4 * q};
    }
    plane.covariance = parts * C * parts.transpose();
    const double nees = x.dot(C.inverse() * x);
    for (const Alignment& gauge :
         {Alignment{}, Alignment{1.0, {R, {-5, 1, 4}}}, Alignment{2.5, {R, {-5, 1, 4}}}}) {
      SceneTruth scene = SceneOfTabletop();
      for (Eigen::Vector3d& v : scene.planes[0].vertices_g) {
        v = gauge.T_gw * (gauge.scale * (middle + v.x() * p + v.y() * q));
      }
      scene.planes[0].pi_g = Transform(gauge.T_gw, {n, -gauge.scale * n.dot(middle)});
      const MapScore score = ScoreMap({plane}, scene, gauge, {{0, kTabletop, 1}}, {kTabletop});
      ASSERT_TRUE(score.claims.has_value());
      EXPECT_EQ(score.claims->count, 1u);
      EXPECT_NEAR(score.claims->nees.mean, nees, 0.01 * nees) << x.transpose();
      EXPECT_EQ(score.claims->nees.above, nees > 9.348 ? 1.0 : 0.0);
      EXPECT_EQ(score.claims->silent, nees > 25.0 ? 1u : 0u);
    }
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
