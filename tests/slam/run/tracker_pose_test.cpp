#include <gmock/gmock.h>

#include "slam/mapping/plane_evidence.h"
#include "slam/model/map_queries.h"
#include "slam/run/tracker.h"
#include "tests/support/slam_matchers.h"
#include "tests/support/textured_world.h"

namespace slam {
namespace {

TEST(Tracker, GivesEachFrameItsPoseInTheMapAndTheStepFromTheFrameBefore) {
  const Camera camera = CameraOfSize();
  const TexturedCorner corner;
  Tracker tracker(camera, {}, Variant::kFull, nullptr, 0, 1);
  Pose last_cw;
  int keyframes = 0;
  for (int i = 0; i < 40; ++i) {
    Frame frame = corner.See(camera, SwingingPose(4 * i), i);
    const TrackReport report =
        tracker.TrackFrame(frame, cv::Mat3b(camera.height, camera.width, cv::Vec3b(0, 0, 0)));
    ASSERT_TRUE(report.tracked) << "frame " << i;
    ASSERT_EQ(frame.T_lc.has_value(), i > 0);
    // What mapping moves a keyframe by afterwards is not in it.
    if (i > 0) {
      EXPECT_THAT(*frame.T_lc, PoseNear(last_cw * Inverse(frame.T_cw), 2e-3, 3e-3));
    }
    if (report.keyframe) {
      ++keyframes;
      const Pose& kept_cw = tracker.map().keyframes.back().T_cw;
      EXPECT_THAT(frame.T_cw, PoseNear(kept_cw, 1e-12, 1e-12)) << "frame " << i;
    }
    last_cw = frame.T_cw;
  }
  EXPECT_GT(keyframes, 2);
}

TEST(Tracker, TellsItsFirstFrameAtTheSpeedThatAnotherFound) {
  const Camera camera = CameraOfSize();
  const TexturedCorner corner;
  const auto track = [&](Tracker& tracker, int i) {
    Frame frame = corner.See(camera, SwingingPose(4 * (i + 5)), i);
    EXPECT_TRUE(tracker.TrackFrame(frame, cv::Mat3b(camera.height, camera.width)).tracked);
    return frame;
  };
  Tracker first(camera, {}, Variant::kPoints, nullptr, 0, 1);
  std::vector<Frame> seen;
  for (int i = 0; i < 3; ++i) seen.push_back(track(first, i));
  EXPECT_TRUE(seen[0].speed.mean.isZero());

  Tracker second(camera, {}, Variant::kFull, nullptr, 0, 1);
  second.StartFrom(first);
  const Vector6d speed =
      Log(seen[1].T_cw) / (seen[1].timestamp_s - seen[0].timestamp_s);  // seen[0] is the world
  ASSERT_GT(speed.norm(), 0.1);
  EXPECT_LT((track(second, 0).speed.mean - speed).norm(), 0.1 * speed.norm());
}

// A point needs no landmark to lie on a plane of the frame (eq18).
TEST(Tracker, HoldsPointsToPlanesOfWhichNoneIsMatched) {
  const Camera camera = CameraOfSize();
  const TexturedCorner corner;
  const auto last_place = [&](bool use_point_planes) -> Eigen::Vector3d {
    Config config;
    config.point_search.pose.use_point_planes = use_point_planes;
    TrackerHooks hooks;
    hooks.after_association = [](Frame& frame, const Map&) {
      for (PlaneMatch& match : frame.plane_matches) match = {};
    };
    Tracker tracker(camera, config, Variant::kFull, nullptr, 0, 1, hooks);
    Frame frame;
    for (int i = 0; i < 3; ++i) {
      frame = corner.See(camera, SwingingPose(4 * i), i);
      EXPECT_TRUE(tracker.TrackFrame(frame, cv::Mat3b(camera.height, camera.width)).tracked);
    }
    return frame.T_cw.t;
  };
  EXPECT_NE(last_place(true), last_place(false));
}

// Points see the same bent depth, whatever finds no planes to measure it by.
TEST(Tracker, TellsOfWhatASensorBendsWhereThereAreNoPlanes) {
  const Camera camera = CameraOfSize();
  const TexturedCorner corner;
  Tracker tracker(camera, {}, Variant::kPoints, nullptr, 0, 1);
  for (int i = 0; i < 2; ++i) {
    Frame frame = corner.See(camera, SwingingPose(4 * i), i);
    ASSERT_TRUE(tracker.TrackFrame(frame, cv::Mat3b(camera.height, camera.width)).tracked);
    EXPECT_EQ(frame.bend_ratio, SensorModel{}.bend_ratio);
  }
}

// What a sensor bends is the same in all frames of a camera at rest: they are one view.
TEST(Tracker, KnowsALandmarkNoBetterForSeeingItLongerFromOnePlace) {
  constexpr double kBend_m = 0.01;
  const Camera camera = CameraOfSize();
  const TexturedCorner corner;
  TrackerHooks hooks;
  hooks.after_association = [&](Frame& frame, const Map&) {
    for (FramePlane& plane : frame.planes) plane.bend_offset_sigma_m = kBend_m;
  };
  Tracker tracker(camera, {}, Variant::kFull, nullptr, 0, 1, hooks);
  for (int i = 0; i < 20; ++i) {
    Frame frame = corner.See(camera, SwingingPose(0), i);
    ASSERT_TRUE(tracker.TrackFrame(frame, cv::Mat3b(camera.height, camera.width)).tracked);
  }
  int landmarks = 0;
  for (const MapPlane& plane : tracker.map().planes) {
    if (plane.status != LandmarkStatus::kLandmark) continue;
    ++landmarks;
    EXPECT_GE(plane.observations, 15);
    EXPECT_GT(BestKnown(plane.estimate).offset_sigma_m, 0.9 * kBend_m);
  }
  EXPECT_GE(landmarks, 2);
}

// What stands 50 mm beside its landmark is seen of another surface. Here it is told so well, and by
// so few points, that it outweighs them all.
TEST(Tracker, BelievesThePointsOfAFrameWhosePlanesAreAllOnWrongLandmarks) {
  constexpr int kWrong = 20;
  const Camera camera = CameraOfSize();
  const TexturedCorner corner;
  int moved = 0;
  TrackerHooks hooks;
  hooks.after_association = [&](Frame& frame, const Map&) {
    if (frame.index != kWrong) return;
    for (std::size_t f = 0; f < frame.planes.size(); ++f) {
      if (frame.plane_matches[f].decision != PlaneDecision::kMatched) continue;
      FramePlane& plane = frame.planes[f];
      plane.pi_c.d += 0.05;
      plane.offset_sigma_m = plane.angle_sigma_rad = 1e-6;
      plane.bend_offset_sigma_m = plane.bend_angle_sigma_rad = 0;
      ++moved;
    }
    for (std::size_t f = 0; f < frame.map_points.size(); ++f)
      if (f % 20 != 0) frame.map_points[f] = kNone;
  };
  Config flat;  // maps planes as sharply
  flat.sensor.bend_ratio = 0;
  Tracker tracker(camera, flat, Variant::kFull, nullptr, 0, 1, hooks);
  for (int i = 0; i <= kWrong; ++i) {
    Frame frame = corner.See(camera, SwingingPose(4 * i), i);
    const TrackReport report =
        tracker.TrackFrame(frame, cv::Mat3b(camera.height, camera.width, cv::Vec3b(0, 0, 0)));
    ASSERT_TRUE(report.tracked) << "frame " << i;
    if (i < kWrong) continue;
    ASSERT_GE(moved, 2);
    EXPECT_THAT(frame.T_cw,
                PoseNear(SwingingPose(4 * i) * Inverse(SwingingPose(0)), 5e-3, 0.01));
    for (const PlaneMatch& match : frame.plane_matches)
      EXPECT_NE(match.decision, PlaneDecision::kMatched);
  }
}

}  // namespace
}  // namespace slam
