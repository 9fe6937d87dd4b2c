#include "slam/localise/keyframe_decision.h"

#include <gtest/gtest.h>

#include "tests/support/point_world.h"

namespace slam {
namespace {

/// The first keyframe seen again, with only `kept` of its matches.
Frame Again(const PointWorld& world, int kept) {
  const Keyframe& keyframe = world.map.keyframes[0];
  Frame frame;
  frame.index = 10;
  frame.features = keyframe.features;
  for (PointFeature& feature : frame.features) feature.depth_m = 0;
  frame.map_points = keyframe.map_points;
  for (std::size_t f = static_cast<std::size_t>(kept); f < frame.map_points.size(); ++f) {
    frame.map_points[f] = kNone;
  }
  return frame;
}

bool Wanted(const PointWorld& world, const Frame& frame, int since = 10) {
  return DecideKeyframe(frame, world.map, 0, since, world.camera, {}, {}).wanted;
}

TEST(KeyframeDecision, WantsAFrameThatHasLostSightOfAQuarterOfTheReference) {
  const PointWorld world = MakePointWorld(2, 200, 1);
  const int all = static_cast<int>(world.map.keyframes[0].features.size());
  EXPECT_FALSE(Wanted(world, Again(world, all)));
  EXPECT_FALSE(Wanted(world, Again(world, static_cast<int>(0.8 * all))));
  EXPECT_TRUE(Wanted(world, Again(world, static_cast<int>(0.7 * all))));
}

TEST(KeyframeDecision, WantsAFrameWithManyNewClosePointsAndFewTrackedOnes) {
  const PointWorld world = MakePointWorld(2, 200, 1);
  const int all = static_cast<int>(world.map.keyframes[0].features.size());
  Frame frame = Again(world, all);
  EXPECT_FALSE(Wanted(world, frame));
  for (int i = 0; i < 100; ++i) {
    PointFeature feature;
    feature.u_px = {10.0 + i, 20.0};
    feature.depth_m = 1.0;
    frame.features.push_back(feature);
    frame.map_points.push_back(kNone);
  }
  EXPECT_TRUE(Wanted(world, frame));
}

TEST(KeyframeDecision, WantsAFrameThatSeesWhatItKnowsFromANewSide) {
  const PointWorld world = MakePointWorld(2, 200, 1);
  Frame frame = Again(world, static_cast<int>(world.map.keyframes[0].features.size()));
  const double around_m = 2.0;  // the points are 1 to 3 m away
  for (const int side : {-1, 1}) {
    frame.T_cw = world.map.keyframes[0].T_cw;
    frame.T_cw.t.x() += side * 0.12 * around_m;
    EXPECT_FALSE(Wanted(world, frame)) << "7 degrees";
    frame.T_cw.t.x() += side * 0.32 * around_m;
    EXPECT_TRUE(Wanted(world, frame)) << "24 degrees";
  }
  // Turning on the spot shows no point from another side.
  frame.T_cw = Pose{ExpSo3({0, 0.3, 0.5}), {}} * world.map.keyframes[0].T_cw;
  EXPECT_FALSE(Wanted(world, frame));
}

TEST(KeyframeDecision, TakesEveryKeyframeThatSawAPointForItsLook) {
  PointWorld world = MakePointWorld(2, 200, 1);
  Frame frame = Again(world, static_cast<int>(world.map.keyframes[0].features.size()));
  frame.T_cw.t.x() = 0.9;
  ASSERT_TRUE(Wanted(world, frame));
  world.map.keyframes[1].T_cw = frame.T_cw;
  EXPECT_FALSE(Wanted(world, frame));
}

TEST(KeyframeDecision, WantsNoFrameThatHardlyHoldsOn) {
  const PointWorld world = MakePointWorld(2, 200, 1);
  EXPECT_FALSE(Wanted(world, Again(world, 15)));
  EXPECT_TRUE(Wanted(world, Again(world, 16)));
}

TEST(KeyframeDecision, WantsNoneAtOnceAfterAnother) {
  const PointWorld world = MakePointWorld(2, 200, 1);
  EXPECT_FALSE(Wanted(world, Again(world, 20), 0));
}

}  // namespace
}  // namespace slam
