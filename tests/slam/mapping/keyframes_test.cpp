#include "slam/mapping/keyframes.h"

#include <gmock/gmock.h>

#include "slam/mapping/map_points.h"
#include "tests/support/point_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

Frame FrameOf(const Keyframe& keyframe) {
  Frame frame;
  frame.index = keyframe.frame_index + 5;
  frame.T_cw = keyframe.T_cw;
  frame.features = keyframe.features;
  frame.map_points = keyframe.map_points;
  return frame;
}

TEST(Keyframes, AddAnObservationForEachMatchAndAPointForEachUnmatchedDepth) {
  PointWorld world = MakePointWorld(2, 80, 1);
  Frame frame = FrameOf(world.map.keyframes[1]);
  const int matched = frame.map_points[0];
  frame.map_points[1] = kNone;
  frame.map_points[2] = kNone;
  frame.features[2].depth_m = 0;
  const std::size_t points_before = world.map.points.size();
  const std::size_t seen_before =
      world.map.points[static_cast<std::size_t>(matched)].observations.size();

  const int id = InsertKeyframe(frame, world.map, world.camera, {});
  EXPECT_EQ(id, 2);
  EXPECT_EQ(world.map.points.size(), points_before + 1);
  EXPECT_EQ(world.map.points[static_cast<std::size_t>(matched)].observations.size(),
            seen_before + 1);
  EXPECT_EQ(frame.map_points, world.map.keyframes[2].map_points);
  EXPECT_EQ(frame.map_points[2], kNone);
  // The new point lies where the feature saw it.
  const MapPoint& made = world.map.points.back();
  EXPECT_THAT(Eigen::Vector3d(frame.T_cw * made.p_w),
              VectorNear(Eigen::Vector3d(world.camera.Backproject(frame.features[1].u_px,
                                                                  frame.features[1].depth_m)),
                         1e-12));
}

TEST(Keyframes, ForgetMatchesWithPointsThatWereCulledAndFollowFusedOnes) {
  PointWorld world = MakePointWorld(2, 80, 2);
  Frame frame = FrameOf(world.map.keyframes[1]);
  for (PointFeature& feature : frame.features) feature.depth_m = 0;
  const int culled = frame.map_points[0], fused = frame.map_points[1];
  const int into =
      PointAt(world.map, 0, 0) == fused ? PointAt(world.map, 0, 1) : PointAt(world.map, 0, 0);
  for (int& slot : frame.map_points) slot = slot == into ? kNone : slot;
  CullPoint(world.map, culled);
  if (culled != into) ReplacePoint(world.map, fused, into);
  InsertKeyframe(frame, world.map, world.camera, {});
  EXPECT_EQ(frame.map_points[0], kNone);
  EXPECT_EQ(frame.map_points[1], culled == into ? fused : into);
}

TEST(Keyframes, ShareAsManyPointsOneWayAsTheOther) {
  const Map map = MakePointWorld(5, 150, 3).map;
  for (const Keyframe& keyframe : map.keyframes) {
    EXPECT_FALSE(keyframe.covisible.empty());
    for (const auto& [other, shared] : keyframe.covisible) {
      EXPECT_EQ(map.keyframes[static_cast<std::size_t>(other)].covisible.at(keyframe.id),
                shared);
    }
  }
}

TEST(Keyframes, RankTheirNeighboursBySharedPoints) {
  Map map = MakePointWorld(5, 150, 4).map;
  const auto best = BestCovisible(map, 0, 3);
  ASSERT_EQ(best.size(), 3u);
  const auto& shared = map.keyframes[0].covisible;
  EXPECT_GE(shared.at(best[0]), shared.at(best[1]));
  EXPECT_GE(shared.at(best[1]), shared.at(best[2]));
  EXPECT_THAT(BestCovisible(map, 0, 0), testing::IsEmpty());
}

TEST(Keyframes, AreCulledWhenOthersSeeTheSameExceptTheFirstAndTheNewestTwo) {
  PointWorld world = MakePointWorld(6, 200, 5);
  const int culled = CullKeyframes(world.map, 5, world.camera, {});
  EXPECT_GE(culled, 1);
  EXPECT_FALSE(world.map.keyframes[0].culled);
  EXPECT_FALSE(world.map.keyframes[4].culled);
  EXPECT_FALSE(world.map.keyframes[5].culled);
  for (const Keyframe& keyframe : world.map.keyframes) {
    EXPECT_EQ(keyframe.features.capacity() == 0, keyframe.culled);  // memory is given back
  }
  for (const MapPoint& point : world.map.points) {
    for (const auto& [keyframe, feature] : point.observations) {
      EXPECT_FALSE(world.map.keyframes[static_cast<std::size_t>(keyframe)].culled);
    }
  }
}

TEST(Keyframes, FollowTheOneThatReplacedThemWhenItMoves) {
  PointWorld world = MakePointWorld(6, 200, 6);
  std::vector<Pose> before;
  for (const Keyframe& keyframe : world.map.keyframes) before.push_back(keyframe.T_cw);
  CullKeyframes(world.map, 5, world.camera, {});
  const Pose T_wv{ExpSo3({0.1, -0.2, 0.3}), {1, 2, 3}};  // v: the world, moved
  int checked = 0;
  for (Keyframe& keyframe : world.map.keyframes) {
    if (!keyframe.culled) keyframe.T_cw = keyframe.T_cw * T_wv;
  }
  for (const Keyframe& keyframe : world.map.keyframes) {
    checked += keyframe.culled;
    EXPECT_THAT(KeyframePose(world.map, keyframe.id),
                PoseNear(before[static_cast<std::size_t>(keyframe.id)] * T_wv, 1e-9, 1e-9));
  }
  EXPECT_GE(checked, 1);
}

}  // namespace
}  // namespace slam
