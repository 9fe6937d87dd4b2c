#include "slam/mapping/point_fusion.h"

#include <gtest/gtest.h>

#include "slam/mapping/map_points.h"
#include "tests/support/point_world.h"

namespace slam {
namespace {

/// Splits a point in two: keyframe 2 gets a copy of its own, a little off.
int SplitOff(Map& map, int point) {
  MapPoint& p = map.points[static_cast<std::size_t>(point)];
  const int feature = p.observations.at(2);
  p.observations.erase(2);
  map.keyframes[2].map_points[static_cast<std::size_t>(feature)] = kNone;
  return AddPoint(map, p.p_w + Eigen::Vector3d(0.001, 0, 0), 2, feature, {});
}

TEST(PointFusion, MakesOneOfTwoCopiesAndKeepsTheBetterSeenOne) {
  PointWorld world = MakePointWorld(3, 100, 1);
  const int original = PointAt(world.map, 2, 0);
  const int copy = SplitOff(world.map, original);
  EXPECT_GE(FusePoints(world.map, 2, world.camera, {}), 1);
  EXPECT_EQ(CurrentPoint(world.map, copy), original);
  EXPECT_EQ(world.map.points[static_cast<std::size_t>(original)].observations.size(), 3u);
}

TEST(PointFusion, GivesAPointTheFeatureThatMatchingHadMissed) {
  PointWorld world = MakePointWorld(3, 100, 2);
  const int point = PointAt(world.map, 2, 0);
  RemoveObservation(world.map, point, 2);
  ASSERT_FALSE(world.map.points[static_cast<std::size_t>(point)].culled);
  FusePoints(world.map, 2, world.camera, {});
  EXPECT_TRUE(world.map.points[static_cast<std::size_t>(point)].observations.count(2));
}

TEST(PointFusion, LeavesPointsApartThatLookDifferent) {
  PointWorld world = MakePointWorld(3, 100, 3);
  const int original = PointAt(world.map, 2, 0);
  const int copy = SplitOff(world.map, original);
  const int feature = world.map.points[static_cast<std::size_t>(copy)].observations.at(2);
  auto& descriptor =
      world.map.keyframes[2].features[static_cast<std::size_t>(feature)].descriptor;
  for (auto& byte : descriptor) byte = static_cast<std::uint8_t>(byte ^ 0x33);
  UpdatePoint(world.map, copy, {});
  FusePoints(world.map, 2, world.camera, {});
  EXPECT_EQ(CurrentPoint(world.map, copy), copy);
  EXPECT_EQ(CurrentPoint(world.map, original), original);
}

}  // namespace
}  // namespace slam
