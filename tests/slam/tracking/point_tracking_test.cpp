#include "slam/tracking/point_tracking.h"

#include <gmock/gmock.h>

#include "tests/slam/tracking/point_odometer.h"
#include "tests/support/point_world.h"
#include "tests/support/slam_matchers.h"
#include "tests/support/textured_world.h"

namespace slam {
namespace {

// A pixel is 8 mm at 2 m (f = 262 px), and a turn of the camera looks nearly like a step aside.
// Measured over 60 frames: at most 10 mm and 5 mrad at 320 x 240, 24 mm and 13 mrad at 160 x
// 120.
constexpr double kPosition_m = 0.015;
constexpr double kRotation_rad = 0.008;

Pose TruthOf(int index) { return SwingingPose(index) * Inverse(SwingingPose(0)); }

Frame SeeSwinging(const TexturedCorner& world, const Camera& camera, int index) {
  return world.See(camera, SwingingPose(index), index);
}

TEST(PointTracking, FollowsAHandThroughATexturedCorner) {
  const TexturedCorner world;
  PointOdometer odometer(CameraOfSize());
  for (int i = 0; i < 60; ++i) {
    Frame frame = SeeSwinging(world, odometer.camera, i);
    const PointTrackReport report = odometer.Step(frame);
    ASSERT_EQ(report.state, TrackState::kTracking) << "frame " << i;
    EXPECT_EQ(report.started, i == 0);
    EXPECT_THAT(frame.T_cw, PoseNear(TruthOf(i), kRotation_rad, kPosition_m)) << "frame " << i;
  }
  EXPECT_GE(odometer.map.keyframes.size(), 2u);
}

TEST(PointTracking, WorksWithImagesOf160By120) {
  const TexturedCorner world(2);
  PointOdometer odometer(CameraOfSize(160, 120));
  for (int i = 0; i < 30; ++i) {
    Frame frame = SeeSwinging(world, odometer.camera, i);
    ASSERT_EQ(odometer.Step(frame).state, TrackState::kTracking) << "frame " << i;
    // Pixels are twice as coarse.
    EXPECT_THAT(frame.T_cw, PoseNear(TruthOf(i), 2 * kRotation_rad, 2 * kPosition_m))
        << "frame " << i;
  }
}

TEST(PointTracking, SaysLostOnABlackFrameAndFindsItselfAgainLater) {
  const TexturedCorner world;
  PointOdometer odometer(CameraOfSize());
  for (int i = 0; i < 40; ++i) {
    Frame frame = SeeSwinging(world, odometer.camera, i);
    const bool black = i >= 20 && i < 28;
    if (black) frame.gray.setTo(0);
    const PointTrackReport report = odometer.Step(frame);
    if (black) {
      EXPECT_EQ(report.state, TrackState::kLost) << "frame " << i;
      EXPECT_THAT(frame.T_cw, PoseNear(Pose{}, 0, 0));
      // The first one knows where motion leads, for whoever else may hold the pose.
      ASSERT_EQ(frame.prediction.has_value(), i == 20) << "frame " << i;
      if (frame.prediction) {
        EXPECT_THAT(frame.prediction->T_cw, PoseNear(TruthOf(i), 0.02, 0.02));
      }
    } else {
      ASSERT_EQ(report.state, TrackState::kTracking) << "frame " << i;
      EXPECT_EQ(report.by_relocalising, i == 28) << "frame " << i;
      EXPECT_THAT(frame.T_cw, PoseNear(TruthOf(i), kRotation_rad, kPosition_m))
          << "frame " << i;
    }
  }
}

TEST(PointTracking, FindsItselfAfterAJumpThatNoPredictionBridges) {
  const TexturedCorner world;
  PointOdometer odometer(CameraOfSize());
  for (int i = 0; i < 10; ++i) {
    Frame frame = SeeSwinging(world, odometer.camera, i);
    odometer.Step(frame);
  }
  const Pose jumped = Pose{ExpSo3({0.02, 0.2, 0.5}), {0.1, 0.05, 0.05}} * SwingingPose(0);
  Frame frame = world.See(odometer.camera, jumped, 10);
  const PointTrackReport report = odometer.Step(frame);
  ASSERT_EQ(report.state, TrackState::kTracking);
  EXPECT_FALSE(report.by_motion || report.by_relocalising) << "by its reference keyframe";
  EXPECT_THAT(frame.T_cw,
              PoseNear(jumped * Inverse(SwingingPose(0)), kRotation_rad, kPosition_m));
}

TEST(PointTracking, TakesNoJumpForASpeed) {
  // A speed says where late depth was measured. That of a hand is found with the pose.
  const TexturedCorner world;
  PointOdometer odometer(CameraOfSize());
  for (int i = 0; i < 10; ++i) {
    Frame frame = SeeSwinging(world, odometer.camera, i);
    frame.depth_late_s = 0.001;
    ASSERT_EQ(odometer.Step(frame).state, TrackState::kTracking);
    EXPECT_EQ(frame.speed.mean.isZero(), i < 1) << i;
  }
  const Pose jumped = Pose{ExpSo3({0.02, 0.2, 0.5}), {0.1, 0.05, 0.05}} * SwingingPose(0);
  Frame frame = world.See(odometer.camera, jumped, 10);
  frame.depth_late_s = 0.001;
  ASSERT_EQ(odometer.Step(frame).state, TrackState::kTracking);
  EXPECT_TRUE(frame.speed.mean.isZero());  // as it was predicted here
  EXPECT_TRUE(odometer.tracking.Speed(frame.timestamp_s + 0.033).mean.isZero());
}

TEST(PointTracking, TellsFeaturesAtTheSpeedOfThePoseThatItFound) {
  const TexturedCorner world;
  PointOdometer odometer(CameraOfSize());
  double apart = 0.0, speed = 0.0;
  for (int i = 0; i < 40; ++i) {
    Frame frame = SeeSwinging(world, odometer.camera, i);
    frame.depth_late_s = 0.015;
    odometer.Extract(frame);
    ASSERT_EQ(odometer.tracking.TrackPoints(frame, odometer.map).state, TrackState::kTracking);
    const Vector6d found = odometer.tracking.SpeedIn(frame).value_or(Vector6d::Zero());
    apart += (frame.speed.mean - found).norm();
    speed += found.norm();
    odometer.Finish(frame);
  }
  EXPECT_LT(apart, 0.2 * speed);  // half of it when told once
}

/// An adjustment that moves the whole map while a frame is tracked is no motion of the camera.
TEST(PointTracking, TakesNoMoveOfTheMapForASpeed) {
  const TexturedCorner world;
  const Pose moved{ExpSo3({0.01, -0.02, 0.03}), {0.05, -0.04, 0.03}};
  Vector6d speed[2];
  for (const bool moves : {false, true}) {
    PointOdometer odometer(CameraOfSize());
    double stamp_s = 0;
    for (int i = 0; i <= 10; ++i) {
      Frame frame = SeeSwinging(world, odometer.camera, i);
      odometer.Extract(frame);
      ASSERT_EQ(odometer.tracking.TrackPoints(frame, odometer.map).state,
                TrackState::kTracking);
      if (moves && i == 10) {
        for (Keyframe& k : odometer.map.keyframes) k.T_cw = k.T_cw * Inverse(moved);
        for (MapPoint& point : odometer.map.points) point.p_w = moved * point.p_w;
        frame.T_cw = frame.T_cw * Inverse(moved);
      }
      if (i == 0) odometer.Finish(frame);
      if (i > 0) odometer.tracking.Accept(frame, odometer.map);
      stamp_s = frame.timestamp_s;
    }
    speed[moves] = odometer.tracking.Speed(stamp_s + 0.03).mean;
  }
  EXPECT_GT(speed[0].norm(), 0.1);
  EXPECT_LT((speed[1] - speed[0]).norm(), 1e-6);
}

TEST(PointTracking, AsksFewerInliersOfAFrameWithFewFeatures) {
  const TexturedCorner world;
  for (const int bound : {120, 400}) {  // of 300 features and more; of 100 a third
    PointTrackingConfig config;
    config.min_inliers = bound, config.min_relocalised_inliers = bound;
    PointOdometer odometer(CameraOfSize(), config);
    Frame first = SeeSwinging(world, odometer.camera, 0);
    ASSERT_EQ(odometer.Step(first).state, TrackState::kTracking);
    Frame frame = SeeSwinging(world, odometer.camera, 1);
    odometer.Extract(frame);
    ASSERT_GT(frame.features.size(), 100u);
    frame.features.resize(100);
    const PointTrackReport report = odometer.tracking.TrackPoints(frame, odometer.map);
    EXPECT_EQ(report.state, bound == 120 ? TrackState::kTracking : TrackState::kLost)
        << bound << ": " << report.inliers;
  }
}

TEST(PointTracking, AsksMoreInliersOfACameraThatWasLost) {
  const TexturedCorner world;
  PointTrackingConfig config;
  config.min_relocalised_inliers = 100000;
  PointOdometer odometer(CameraOfSize(), config);
  for (int i = 0; i < 8; ++i) {
    Frame frame = SeeSwinging(world, odometer.camera, i);
    if (i == 5) frame.gray.setTo(0);
    EXPECT_EQ(odometer.Step(frame).state, i < 5 ? TrackState::kTracking : TrackState::kLost);
  }
}

TEST(PointTracking, StaysLostInAWorldItHasNeverSeen) {
  const TexturedCorner world(1), other(99);
  PointOdometer odometer(CameraOfSize());
  for (int i = 0; i < 25; ++i) {
    const bool elsewhere = i >= 10;
    Frame frame = SeeSwinging(elsewhere ? other : world, odometer.camera, i);
    const PointTrackReport report = odometer.Step(frame);
    EXPECT_EQ(report.state, elsewhere ? TrackState::kLost : TrackState::kTracking)
        << "frame " << i << " inliers " << report.inliers;
  }
}

TEST(PointTracking, WaitsForAFrameWithDepthBeforeItStarts) {
  const TexturedCorner world;
  PointOdometer odometer(CameraOfSize());
  for (int i = 0; i < 6; ++i) {
    Frame frame = SeeSwinging(world, odometer.camera, i);
    if (i < 2) frame.depth_m.setTo(0);
    if (i == 2) frame.gray.setTo(0);
    const PointTrackReport report = odometer.Step(frame);
    EXPECT_EQ(report.state, i < 3 ? TrackState::kInitialising : TrackState::kTracking);
    EXPECT_EQ(report.started, i == 3);
  }
}

TEST(PointTracking, GoesOnWithoutDepthOnceItHasAMap) {
  const TexturedCorner world;
  PointOdometer odometer(CameraOfSize());
  for (int i = 0; i < 12; ++i) {
    Frame frame = SeeSwinging(world, odometer.camera, i);
    if (i >= 5) frame.depth_m.setTo(0);
    ASSERT_EQ(odometer.Step(frame).state, TrackState::kTracking) << "frame " << i;
    EXPECT_THAT(frame.T_cw, PoseNear(TruthOf(i), kRotation_rad, kPosition_m)) << "frame " << i;
  }
}

TEST(PointTracking, StandsStillWhenTheFrameRepeats) {
  const TexturedCorner world;
  PointOdometer odometer(CameraOfSize());
  for (int i = 0; i < 10; ++i) {
    Frame frame = world.See(odometer.camera, Pose{}, i);
    ASSERT_EQ(odometer.Step(frame).state, TrackState::kTracking);
    EXPECT_THAT(frame.T_cw, PoseNear(Pose{}, 1e-6, 1e-6));
  }
  EXPECT_EQ(odometer.map.keyframes.size(), 1u);
}

TEST(PointTracking, GoesOnByMotionWhenTheMapIsMovedUnderIt) {
  const TexturedCorner world;
  PointOdometer odometer(CameraOfSize());
  const Pose T_new_old{ExpSo3({0.3, -0.5, 0.2}), {1.0, -2.0, 0.5}};
  for (int i = 0; i < 12; ++i) {
    if (i == 5 || i == 8) {  // as closing a loop does
      for (Keyframe& keyframe : odometer.map.keyframes) {
        keyframe.T_cw = keyframe.T_cw * Inverse(T_new_old);
      }
      for (MapPoint& point : odometer.map.points) {
        point.p_w = T_new_old * point.p_w;
        point.view_w = T_new_old.R * point.view_w;
      }
      odometer.tracking.FollowMap(odometer.map);
    }
    Frame frame = SeeSwinging(world, odometer.camera, i);
    odometer.Extract(frame);
    const PointTrackReport report = odometer.tracking.TrackPoints(frame, odometer.map);
    ASSERT_EQ(report.state, TrackState::kTracking) << "frame " << i;
    EXPECT_EQ(report.by_motion, i > 0) << "frame " << i;
    const auto T_lc = odometer.tracking.FromLast(frame.T_cw, odometer.map);
    ASSERT_EQ(T_lc.has_value(), i > 0);
    if (i > 0) {
      EXPECT_THAT(*T_lc,
                  PoseNear(TruthOf(i - 1) * Inverse(TruthOf(i)), kRotation_rad, kPosition_m));
    }
    odometer.Finish(frame);
    Pose back_cw = frame.T_cw;  // in the world as it was at first
    for (const int moved : {5, 8}) {
      if (i >= moved) back_cw = back_cw * T_new_old;
    }
    EXPECT_THAT(back_cw, PoseNear(TruthOf(i), kRotation_rad, kPosition_m)) << "frame " << i;
  }
}

TEST(PointTracking, CountsOnItsPointsInWhichFramesTheyShouldBeSeenAndAre) {
  const TexturedCorner world;
  PointOdometer odometer(CameraOfSize());
  const auto counts = [&] {
    std::pair<int, int> sums{0, 0};
    for (const MapPoint& point : odometer.map.points) {
      sums.first += point.visible_count, sums.second += point.found_count;
    }
    return sums;
  };
  for (int i = 0; i < 6; ++i) {
    Frame frame = SeeSwinging(world, odometer.camera, i);
    odometer.Extract(frame);
    const auto [visible, found] = counts();
    const PointTrackReport report = odometer.tracking.TrackPoints(frame, odometer.map);
    if (i > 0) {
      EXPECT_EQ(counts().second - found, report.inliers);
      EXPECT_GT(counts().first - visible, report.inliers);
    } else {
      InsertKeyframe(frame, odometer.map, odometer.camera, FeatureScale{},
                     odometer.mapping.keyframes);
    }
    odometer.tracking.Accept(frame, odometer.map);
  }
}

// What lies on edges agrees that the camera has moved along them; few points know better.
TEST(PointTracking, LeavesOutWhatLiesOnEdgesWhereFewPointsTellTheirPlace) {
  const PointWorld world = MakePointWorld(1, 260, 3);
  const std::vector<PointFeature>& features = world.map.keyframes[0].features;
  ASSERT_GT(features.size(), 150u);
  PointOdometer odometer(world.camera);
  Frame first, second;
  first.features = features;
  ASSERT_EQ(odometer.tracking.TrackPoints(first, odometer.map).state, TrackState::kTracking);
  odometer.Finish(first);
  second.index = 1;
  second.timestamp_s = 1.0 / 30;
  constexpr std::size_t kSure = 40;
  second.features = features;
  for (std::size_t f = kSure; f < features.size(); ++f) {
    second.features[f].on_edge = true;
    second.features[f].u_px.x() += 1.2;
  }
  const PointTrackReport report = odometer.tracking.TrackPoints(second, odometer.map);
  ASSERT_EQ(report.state, TrackState::kTracking);
  EXPECT_LE(report.inliers, static_cast<int>(kSure));
  // 1.2 px are 4.6 mm at 2 m.
  EXPECT_THAT(second.T_cw, PoseNear(Pose{}, 5e-4, 5e-4));
}

TEST(PointTracking, GivesTheSameBytesTwice) {
  const TexturedCorner world;
  PointOdometer first(CameraOfSize()), second(CameraOfSize());
  for (int i = 0; i < 25; ++i) {
    Frame a = SeeSwinging(world, first.camera, i), b = SeeSwinging(world, second.camera, i);
    if (i == 12) a.gray.setTo(0), b.gray.setTo(0);  // through relocalisation as well
    first.Step(a);
    second.Step(b);
    EXPECT_EQ(a.T_cw.R, b.T_cw.R);
    EXPECT_EQ(a.T_cw.t, b.T_cw.t);
    EXPECT_EQ(a.map_points, b.map_points);
  }
}

}  // namespace
}  // namespace slam
