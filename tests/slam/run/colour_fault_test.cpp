#include <gmock/gmock.h>

#include <cmath>
#include <utility>

#include "tests/support/stream_run.h"

namespace slam {
namespace {

void Roll(RecordedFrame& frame) {
  const double gain = std::pow(5.0, std::sin(0.2 * frame.index));
  cv::Mat1b gray;
  frame.gray.convertTo(gray, CV_8U, gain);
  SetColour(frame, gray);
}

void Invert(RecordedFrame& frame) {
  cv::Mat1b gray;
  cv::bitwise_not(frame.gray, gray);
  SetColour(frame, gray);
}

TEST(FaultStreamF16, BrightnessThatRollsAndNegativesGiveNoWrongPose) {
  ExpectNoWrongPose(RunOn(Changed(Clean(), 0, kFrames, Roll)), 2 * kPosition_m);
  ExpectNoWrongPose(RunOn(Changed(Clean(), 30, 30, Invert)), 2 * kPosition_m);
}

TEST(FaultStreamF16, WhatDepthSaysOfPlanesIsTheSameToTheBitWhateverTheColour) {
  constexpr int kSome = 30;
  const auto stream = CleanStream(kSome);
  const Ran clean = RunOn(stream, Variant::kFull);
  const auto map = nlohmann::json::parse(clean.map).at("planes");
  ASSERT_EQ(map.size(), 3u);  // the walls
  const std::pair<int, void (*)(RecordedFrame&)> changes[] = {
      {0, Roll}, {0, Invert}, {15, Invert}};
  for (const auto& [from, change] : changes) {
    const Ran ran = RunOn(Changed(stream, from, kSome, change), Variant::kFull);
    ExpectNoWrongPose(ran, 2 * kPosition_m);
    ASSERT_EQ(ran.planes.size(), clean.planes.size());
    for (std::size_t i = 0; i < ran.planes.size(); ++i) {
      EXPECT_EQ(Measured(ran.planes[i]), Measured(clean.planes[i])) << "frame " << i;
    }
    // Poses come from colour, so that the map is as near to the true walls, not the same bits.
    const auto planes = nlohmann::json::parse(ran.map).at("planes");
    ASSERT_EQ(planes.size(), map.size());
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const auto& n = planes[k].at("normal");
      const auto& n_clean = map[k].at("normal");
      double cosine = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        cosine += n[axis].get<double>() * n_clean[axis].get<double>();
      }
      EXPECT_GT(cosine, std::cos(0.01));
      EXPECT_NEAR(planes[k].at("d"), map[k].at("d"), 2 * kPosition_m);
    }
  }
}

}  // namespace
}  // namespace slam
