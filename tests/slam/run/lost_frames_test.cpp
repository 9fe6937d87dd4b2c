#include "slam/run/lost_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slam {
namespace {

/// Frames at 10 Hz; '+' is tracked, '-' is not.
LostFrames Seen(const std::string& frames) {
  LostFrames lost;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    lost.See(static_cast<double>(i) / 10, frames[i] == '+');
  }
  return lost;
}

TEST(LostFrames, WarnOfNothingWhenAllAreTracked) {
  EXPECT_EQ(Seen("++++").Warning(), "");
  EXPECT_FALSE(Seen("++++").ended_lost());
}

TEST(LostFrames, SayHowManyAndTheFirstWhenTheCameraWasFoundAgain) {
  EXPECT_EQ(Seen("+--+-+").Warning(),
            "3 of 6 frames are not tracked, the first of them frame 1 (0.100000 s)");
}

TEST(LostFrames, SaySinceWhenTheCameraIsLost) {
  const LostFrames lost = Seen("+-++---");
  EXPECT_TRUE(lost.ended_lost());
  EXPECT_EQ(
      lost.Warning(),
      "4 of 7 frames are not tracked; the camera is lost since frame 4 (0.400000 s) and was "
      "not found again");
}

TEST(LostFrames, LeaveItToOthersToSayThatTrackingNeverStarted) {
  EXPECT_EQ(Seen("---").Warning(), "");
  EXPECT_TRUE(Seen("---").ended_lost());
}

}  // namespace
}  // namespace slam
