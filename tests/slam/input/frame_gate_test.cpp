#include "slam/input/frame_gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

namespace slam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

Camera GateCamera() {
  Camera camera;
  camera.width = 32, camera.height = 24;
  return camera;
}

RecordedFrame FrameAt(double t_s) {
  RecordedFrame frame;
  frame.timestamp_s = t_s;
  frame.bgr = cv::Mat3b(24, 32, cv::Vec3b(1, 2, 3));
  frame.gray = cv::Mat1b(24, 32, 2);
  frame.depth_m = cv::Mat1f(24, 32, 1.0f);
  return frame;
}

double DelayTaken(double late_s) {
  RecordedFrame frame = FrameAt(0);
  frame.depth_late_s = late_s;
  FrameGate gate(GateCamera());
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

TEST(FrameGate, CountsTheFramesThatAreNotLaterThanAllBefore) {
  FrameGate gate(GateCamera());
  std::vector<bool> taken;
  for (const double t_s : {1.0, 3.0, 3.0, 2.0, 4.0}) {
    RecordedFrame frame = FrameAt(t_s);
    taken.push_back(gate.Takes(frame));
  }
  EXPECT_THAT(taken, ElementsAre(true, true, false, false, true));
  EXPECT_THAT(gate.Warnings(), ElementsAre(StartsWith("2 frames were left out")));
}

/// What is said of twelve frames that show one depth but for the first ones, which show 1 m.
std::vector<std::string> WarningsOfDepth(float depth_m, int usual = 3) {
  FrameGate gate(GateCamera());
  for (int i = 0; i < 12; ++i) {
    RecordedFrame frame = FrameAt(i);
    if (i >= usual) frame.depth_m = depth_m;
    EXPECT_TRUE(gate.Takes(frame));
  }
  return gate.Warnings();
}

TEST(FrameGate, DoubtsTheDepthFactorWhenMostFramesAreTooNearOrTooFar) {
  EXPECT_THAT(WarningsOfDepth(0.2f),
              ElementsAre(StartsWith("in 9 of 12 frames most of the depth is nearer")));
  EXPECT_THAT(WarningsOfDepth(9.0f),
              ElementsAre(StartsWith("in 9 of 12 frames most of the depth is beyond")));
  EXPECT_THAT(WarningsOfDepth(1.5f), IsEmpty());
  // Half of the frames are not most of them.
  for (const float odd_m : {0.2f, 9.0f}) EXPECT_THAT(WarningsOfDepth(odd_m, 6), IsEmpty());
}

// A desk 0.9 m away, told in fifths of a millimetre and read in millimetres.
TEST(FrameGate, DoubtsTheDepthFactorWhenNothingIsNear) {
  EXPECT_THAT(WarningsOfDepth(4.5f),
              ElementsAre("in 9 of 12 frames nearly all of the depth is beyond 3 m; is "
                          "depth_factor of the camera right?"));
  FrameGate hall(GateCamera());
  for (int i = 0; i < 12; ++i) {
    RecordedFrame frame = FrameAt(i);
    frame.depth_m = 4.5f;
    frame.depth_m.row(16) = 1.5f;  // the floor before the camera, in half of the samples
    EXPECT_TRUE(hall.Takes(frame));
  }
  EXPECT_THAT(hall.Warnings(), IsEmpty());
}

// A covered sensor measures nothing, which says nothing of the unit.
TEST(FrameGate, DoesNotDoubtTheDepthFactorWhenMostFramesHaveNoDepth) {
  EXPECT_THAT(WarningsOfDepth(0.0f), IsEmpty());
  EXPECT_THAT(WarningsOfDepth(std::nanf("")), IsEmpty());
}

// A recorder or a window may hold the same image.
TEST(FrameGate, MendsImpossibleDepthOnACopy) {
  const cv::Mat1f source(24, 32, 1.0f);
  const float nan = std::nanf("");
  cv::Mat1f held = source.clone();
  held(3, 4) = -2.0f, held(5, 6) = nan, held(7, 8) = 1e6f;
  RecordedFrame frame = FrameAt(0);
  frame.depth_m = held;
  FrameGate gate(GateCamera());
  ASSERT_TRUE(gate.Takes(frame));
  EXPECT_EQ(frame.depth_m(3, 4), 0.0f);
  EXPECT_EQ(frame.depth_m(5, 6), 0.0f);
  EXPECT_EQ(frame.depth_m(7, 8), 0.0f);
  EXPECT_EQ(cv::countNonZero(frame.depth_m == source), 24 * 32 - 3);
  EXPECT_EQ(held(3, 4), -2.0f);
  EXPECT_TRUE(std::isnan(held(5, 6)));
  EXPECT_EQ(held(7, 8), 1e6f);
}

}  // namespace
}  // namespace slam
