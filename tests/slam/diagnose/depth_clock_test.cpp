#include "slam/diagnose/depth_clock.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/textured_world.h"

namespace slam {
namespace {

const Camera& ClockCamera() {
  static const Camera camera = CameraOfSize(160, 120);
  return camera;
}

/// A hand that holds a camera before the corner of a room; `s` seconds on.
Pose HandAt(double s) {
  const Eigen::Vector3d centre_w(0.12 * std::sin(1.5 * s), 0.06 * std::sin(2.5 * s),
                                 0.08 * (1 - std::cos(1.9 * s)));
  return Inverse(Pose{
      ExpSo3({0.06 * std::sin(2.0 * s), 0.1 * std::sin(1.5 * s), 0.04 * std::sin(1.2 * s)}),
      centre_w});
}

/// Depth with noise of 1.4 mm at a metre.
cv::Mat1f DepthSeen(const Pose& T_cw, int frame) {
  static const TexturedCorner corner;
  cv::Mat1f depth_m = corner.See(ClockCamera(), T_cw, frame).depth_m;
  Random random{7, static_cast<std::uint64_t>(frame)};
  for (float& z_m : depth_m) {
    z_m += static_cast<float>(0.005 * (random.Uniform() - 0.5)) * z_m * z_m;
  }
  return depth_m;
}

struct Watched {
  double late_s = 0.0;
  int frames = 90;
  double speed = 1.0;            ///< of the hand
  bool lost_in_between = false;  ///< for 20 frames
  double stamped_s = 0.0;        ///< of the delay, what the stamps say
};

DepthClock Watch(const Watched& watched) {
  DepthClock clock(ClockCamera());
  for (int i = 0; i < watched.frames; ++i) {
    const double s = i / 30.0;
    const bool lost = watched.lost_in_between && i >= 30 && i < 50;
    Frame frame;
    frame.timestamp_s = 100.0 + s;
    frame.measured.depth_m = DepthSeen(HandAt(watched.speed * (s + watched.late_s)), i);
    frame.depth_late_s = watched.stamped_s;
    if (!lost) frame.T_cw_by_pixels = HandAt(watched.speed * s);
    clock.Observe(frame);
  }
  return clock;
}

TEST(DepthClock, SaysByHowMuchDepthIsLateOrEarly) {
  for (const double late_s : {-0.7, -0.1, -1 / 30.0, 0.04, 0.05, 0.3}) {
    const DepthClock clock = Watch({.late_s = late_s});
    ASSERT_TRUE(clock.Late_s()) << late_s;
    EXPECT_NEAR(*clock.Late_s(), late_s, 0.003);  // a tenth of the way from frame to frame
  }
}

TEST(DepthClock, WarnsWithTheTimeAndItsSide) {
  EXPECT_THAT(Watch({.late_s = 0.1}).Warnings(),
              testing::ElementsAre(testing::ContainsRegex("(9[5-9]|10[0-5]) ms after ")));
  EXPECT_THAT(Watch({.late_s = -0.1}).Warnings(),
              testing::ElementsAre(testing::ContainsRegex("(9[5-9]|10[0-5]) ms before ")));
}

TEST(DepthClock, IsSilentWhereTimeStampsCannotBePairedBetter) {
  EXPECT_THAT(Watch({.late_s = 0.015}).Warnings(), testing::IsEmpty());
}

TEST(DepthClock, IsSilentAboutDepthInTime) { EXPECT_FALSE(Watch({}).Late_s()); }

TEST(DepthClock, IsSilentAboutADelayThatTheStampsTell) {
  EXPECT_FALSE(Watch({.late_s = 0.1, .stamped_s = 0.1}).Late_s());
  const DepthClock clock = Watch({.late_s = 0.1, .stamped_s = -0.1});
  ASSERT_TRUE(clock.Late_s());
  EXPECT_NEAR(*clock.Late_s(), 0.2, 0.005);
}

TEST(DepthClock, KnowsNothingWhileTheCameraStands) {
  EXPECT_FALSE(Watch({.late_s = 0.5, .speed = 0.0}).Late_s());
}

TEST(DepthClock, KnowsNothingOfAMotionThatDrownsInNoise) {
  for (const double speed : {0.01, 0.02}) {
    for (const double late_s : {-0.3, 0.3})
      EXPECT_FALSE(Watch({.late_s = late_s, .speed = speed}).Late_s())
          << speed << " " << late_s;
  }
}

TEST(DepthClock, KnowsNothingOfAHandfulOfFrames) {
  EXPECT_FALSE(Watch({.late_s = 0.1, .frames = 10}).Late_s());
}

TEST(DepthClock, GoesOnAfterTheCameraWasLost) {
  const DepthClock clock = Watch({.late_s = 0.1, .lost_in_between = true});
  ASSERT_TRUE(clock.Late_s());
  EXPECT_NEAR(*clock.Late_s(), 0.1, 0.005);
}

// An arm, 32 columns of the image at 0.8 m, sweeps through it again and again. What it uncovers is
// another surface, not the same one that moved.
TEST(DepthClock, IsNotMisledByWhatPassesInFront) {
  for (const double late_s : {-0.1, 0.1}) {
    DepthClock clock(ClockCamera());
    for (int i = 0; i < 90; ++i) {
      const double s = i / 30.0;
      Frame frame;
      frame.timestamp_s = 100.0 + s;
      frame.measured.depth_m = DepthSeen(HandAt(s + late_s), i);
      const cv::Rect arm(i * 11 % 192 - 32, 0, 32, 120);
      frame.measured.depth_m(arm & cv::Rect(0, 0, 160, 120)) = 0.8f;
      frame.T_cw_by_pixels = HandAt(s);
      clock.Observe(frame);
    }
    ASSERT_TRUE(clock.Late_s()) << late_s;
    EXPECT_NEAR(*clock.Late_s(), late_s, 0.01);
  }
}

}  // namespace
}  // namespace slam
