#include "slam/run/first_look.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/input/frame_of.h"
#include "tests/support/fault_stream.h"

namespace slam {
namespace {

constexpr double kNearWall_m = 2.0;  // the front wall of the corner, which alone is in view

/// To and fro before that wall, up to 2.4 m/s; at first half as fast.
Pose RushingAt(double s) {
  const double there_m = 0.4 * std::sin(M_PI / 3 + 6 * s);
  return Inverse(Pose{Eigen::Matrix3d::Identity(), {-0.9, -0.8, there_m}});
}

// As two walls, each with a part of what was seen, its own bend could be taken for the device's.
TEST(FirstLook, TakesOneWallForOneThoughItsDepthIsLaterThanItsColour) {
  constexpr double kLate_s = 0.032;
  constexpr int kThereAndBack = 15;
  const Camera camera = CameraOfSize();
  auto frames = SeenStream(kThereAndBack + 1, TexturedCorner(),
                           [](int i) { return RushingAt(i / 30.0); });
  for (RecordedFrame& frame : frames) {
    const double camera_m = -RushingAt(frame.index / 30.0 + kLate_s).t.z();
    frame.depth_m.setTo(kNearWall_m - camera_m);
    frame.depth_late_s = kLate_s;
  }
  FaultStream stream(std::move(frames));
  FirstLook look =
      LookFirst(stream, kThereAndBack, camera, {}, true, 1, [](int) { return true; });
  const RecordedFrame next = stream.Read(kThereAndBack);
  Frame frame = FrameOf(next, kThereAndBack);
  ASSERT_TRUE(look.tracker->TrackFrame(frame, next.bgr).tracked);
  ASSERT_TRUE(look.bend);
  look.bend->Finish();
  EXPECT_EQ(look.bend->evidence().largest_surface, 1.0);
}

}  // namespace
}  // namespace slam
