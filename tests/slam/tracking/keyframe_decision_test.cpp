#include "slam/tracking/keyframe_decision.h"

#include <gtest/gtest.h>

#include "tests/support/point_world.h"

namespace slam {
namespace {

constexpr double kClose_m = 3.0;

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
  return DecideKeyframe(frame, world.map, 0, since, kClose_m, {}).wanted;
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
  const double new_side_m = KeyframeDecisionConfig{}.max_view_rad * around_m;
  for (const int side : {-1, 1}) {
    frame.T_cw = world.map.keyframes[0].T_cw;
    frame.T_cw.t.x() += side * 0.5 * new_side_m;
    EXPECT_FALSE(Wanted(world, frame));
    frame.T_cw.t.x() += side * 1.5 * new_side_m;
    EXPECT_TRUE(Wanted(world, frame));
  }
  // Turning on the spot shows no point from another side.
  frame.T_cw =
      Pose{ExpSo3({0, 0.3, 0.5}), Eigen::Vector3d::Zero()} * world.map.keyframes[0].T_cw;
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

TEST(KeyframeDecision, CountsAPointOfTheReferenceOnceEnoughKeyframesSeeIt) {
  // Of a reference with points that 1, 2, 3 and 4 keyframes see, ten of each kind.
  const auto reference_points = [](int keyframes, int culled) {
    Map map;
    map.keyframes.resize(static_cast<std::size_t>(keyframes));
    for (int k = 0; k < keyframes; ++k) {
      map.keyframes[static_cast<std::size_t>(k)].culled = k >= keyframes - culled;
    }
    for (int i = 0; i < 40; ++i) {
      MapPoint point;
      for (int k = 0; k <= i / 10; ++k) point.observations[k] = i;
      map.points.push_back(point);
      map.keyframes[0].map_points.push_back(i);
    }
    return DecideKeyframe({}, map, 0, 10, kClose_m, {}).reference_points;
  };
  EXPECT_EQ(reference_points(2, 0), 40);
  EXPECT_EQ(reference_points(3, 0), 30);
  EXPECT_EQ(reference_points(4, 0), 20);
  EXPECT_EQ(reference_points(4, 1), 30);
  EXPECT_EQ(reference_points(4, 2), 40);
}

TEST(KeyframeDecision, KnowsALookFromATurnedKeyframe) {
  PointWorld world = MakePointWorld(2, 200, 1);
  Frame frame = Again(world, static_cast<int>(world.map.keyframes[0].features.size()));
  // Both keyframes turned on the spot about an axis aside: their rays in the world stay.
  const Pose turn{ExpSo3({0.4, -0.9, 1.1}), Eigen::Vector3d::Zero()};
  for (Keyframe& keyframe : world.map.keyframes) keyframe.T_cw = turn * keyframe.T_cw;
  frame.T_cw = world.map.keyframes[0].T_cw;
  EXPECT_EQ(DecideKeyframe(frame, world.map, 0, 10, kClose_m, {}).new_looks, 0);
}

TEST(KeyframeDecision, AsksForClosePointsInProportionToTheFeaturesOfTheImage) {
  const KeyframeDecisionConfig config;
  const auto wanted = [&](int features, int tracked, int untracked) {
    Map map;
    map.keyframes.resize(1);
    Frame frame;
    for (int f = 0; f < features; ++f) {
      PointFeature feature;
      feature.depth_m = f < tracked + untracked ? 1.0 : 0.0;
      frame.features.push_back(feature);
      frame.map_points.push_back(f < tracked ? f : kNone);
      if (f >= tracked) continue;
      MapPoint point;
      point.observations[0] = f;
      point.p_w = {0, 0, 1};
      map.points.push_back(point);
    }
    return DecideKeyframe(frame, map, 0, config.min_frames_between, kClose_m, config).wanted;
  };
  const int half_tracked = config.min_close_tracked / 2;
  const int half_untracked = config.min_close_untracked / 2;
  EXPECT_TRUE(wanted(500, half_tracked - 1, half_untracked + 1));
  EXPECT_FALSE(wanted(500, half_tracked + 1, half_untracked + 1));
  EXPECT_FALSE(wanted(500, half_tracked - 1, half_untracked - 1));
  EXPECT_TRUE(wanted(1000, config.min_close_tracked - 1, config.min_close_untracked + 1));
  EXPECT_FALSE(wanted(1000, config.min_close_tracked + 1, config.min_close_untracked + 1));
}

/// A frame of two walls, 1 m and 3 m away, ten frames after the newest keyframe and at its place.
Frame OfPlanes() {
  Frame frame;
  frame.index = 10;
  frame.features.resize(1000);
  frame.planes.resize(2);
  frame.planes[0].centroid_c = {0, 0, 1};
  frame.planes[1].centroid_c = {3, 0, 0};
  return frame;
}

TEST(KeepViewOfPlanes, KeepsAViewFromANewSideOrPlaceAndNoOther) {
  const KeyframeDecisionConfig config;
  const Keyframe newest;
  Frame frame = OfPlanes();
  EXPECT_FALSE(KeepViewOfPlanes(frame, newest, 0, config));
  const double far_m = 2.0 * config.max_view_rad;  // from planes 2 m away
  for (const Eigen::Vector3d& way : {Eigen::Vector3d(1, 0, 0), {0, 0, -1}, {-0.6, 0.8, 0}}) {
    frame.T_cw = {Eigen::Matrix3d::Identity(), 0.95 * far_m * way};
    EXPECT_FALSE(KeepViewOfPlanes(frame, newest, 0, config)) << way.transpose();
    frame.T_cw.t = 1.05 * far_m * way;
    EXPECT_TRUE(KeepViewOfPlanes(frame, newest, 0, config)) << way.transpose();
    frame.T_cw = {ExpSo3(0.95 * config.max_view_rad * way), {0, 0, 0}};
    EXPECT_FALSE(KeepViewOfPlanes(frame, newest, 0, config)) << way.transpose();
    frame.T_cw.R = ExpSo3(1.05 * config.max_view_rad * way);
    EXPECT_TRUE(KeepViewOfPlanes(frame, newest, 0, config)) << way.transpose();
  }
}

TEST(KeepViewOfPlanes, ComparesWithTheNewestKeyframeWhereverItIs) {
  Keyframe newest;
  newest.T_cw = {ExpSo3({0.4, -1.2, 0.3}), {4, -2, 6}};
  Frame frame = OfPlanes();
  EXPECT_TRUE(KeepViewOfPlanes(frame, newest, 0, {}));
  frame.T_cw = newest.T_cw;
  EXPECT_FALSE(KeepViewOfPlanes(frame, newest, 0, {}));
  // A small turn on the spot, metres from the world's origin, is no way.
  frame.T_cw = Pose{ExpSo3({0, 0.5 * KeyframeDecisionConfig{}.max_view_rad, 0}), {0, 0, 0}} *
               newest.T_cw;
  EXPECT_FALSE(KeepViewOfPlanes(frame, newest, 0, {}));
}

TEST(KeepViewOfPlanes, KeepsAFrameThatFollowsManyFeaturesForTheSizeOfItsImage) {
  const KeyframeDecisionConfig config;
  Frame frame = OfPlanes();
  EXPECT_FALSE(KeepViewOfPlanes(frame, {}, config.min_close_untracked, config));
  EXPECT_TRUE(KeepViewOfPlanes(frame, {}, config.min_close_untracked + 1, config));
  frame.features.resize(500);
  EXPECT_FALSE(KeepViewOfPlanes(frame, {}, config.min_close_untracked / 2, config));
  EXPECT_TRUE(KeepViewOfPlanes(frame, {}, config.min_close_untracked / 2 + 1, config));
}

TEST(KeepViewOfPlanes, KeepsTheFrameThatMadeALandmark) {
  Frame frame = OfPlanes();
  for (const PlaneDecision decision :
       {PlaneDecision::kMatched, PlaneDecision::kTrial, PlaneDecision::kUnmatched})
    frame.plane_matches.push_back({decision, 0});
  EXPECT_FALSE(KeepViewOfPlanes(frame, {}, 0, {}));
  frame.plane_matches.push_back({PlaneDecision::kNew, 3});
  EXPECT_TRUE(KeepViewOfPlanes(frame, {}, 0, {}));
}

TEST(KeepViewOfPlanes, KeepsNoneAtOnceAfterAnother) {
  KeyframeDecisionConfig config;
  config.min_frames_between = 5;
  Keyframe newest;
  newest.frame_index = 6;
  newest.T_cw.t.x() = 5.0;
  EXPECT_FALSE(KeepViewOfPlanes(OfPlanes(), newest, 1000, config));
  newest.frame_index = 5;
  EXPECT_TRUE(KeepViewOfPlanes(OfPlanes(), newest, 0, config));
}

}  // namespace
}  // namespace slam
