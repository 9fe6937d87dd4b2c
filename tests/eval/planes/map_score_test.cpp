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

RunMapPlane SquareOnTheTabletop(int id, double half_m) {
  RunMapPlane plane;
  plane.id = id;
  plane.vertices_w = plane.hull_w = SquareOfHalf(half_m);
  return plane;
}

// The small one lies inside the large one, so that the large one is all that both cover.
TEST(ScoreMap, ExplainsByTheLargerOfTwoDuplicatesWhicheverWasSeenMore) {
  SceneTruth scene;
  TruthPlane& top = scene.planes.emplace_back();
  top.id = kTabletop;
  top.scored = true;
  top.area_m2 = 1.0;
  top.vertices_g = SquareOfHalf(0.5);
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

}  // namespace
}  // namespace eval
