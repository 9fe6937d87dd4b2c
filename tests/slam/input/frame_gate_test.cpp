#include "slam/input/frame_gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace slam {
namespace {

double DelayTaken(double late_s) {
  Camera camera;
  camera.width = 32, camera.height = 24;
  RecordedFrame frame;
  frame.bgr = cv::Mat3b(24, 32, cv::Vec3b(1, 2, 3));
  frame.gray = cv::Mat1b(24, 32, 2);
  frame.depth_m = cv::Mat1f(24, 32, 1.0f);
  frame.depth_late_s = late_s;
  FrameGate gate(camera);
  EXPECT_TRUE(gate.Takes(frame));
  return frame.depth_late_s;
}

TEST(FrameGate, BelievesADelayThatAPairOfImagesCanHave) {
  EXPECT_EQ(DelayTaken(0.0167), 0.0167);
  EXPECT_EQ(DelayTaken(-0.033), -0.033);
}

TEST(FrameGate, DoesNotBelieveStampsOfTwoClocks) {
  for (const double late_s :
       {1.0, -0.2, 1.3e9, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(DelayTaken(late_s), 0.0) << late_s;
  }
}

}  // namespace
}  // namespace slam
