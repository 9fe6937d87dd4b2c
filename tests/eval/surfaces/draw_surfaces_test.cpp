#include "eval/surfaces/draw_surfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eval {
namespace {

// A frame full of surfaces that are whole is a good one.
TEST(WorstFrames, AreThoseThatLostMostPixelsWhateverTheyShow) {
  SurfaceScore score;
  score.by_frame = {{0, 9000, 8900}, {1, 2000, 500}, {2, 9500, 9500}, {3, 5000, 4000}};
  const auto views_of_worst = [&](std::size_t count) {
    std::vector<std::size_t> views;
    for (const FrameWholeness& frame : WorstFrames(score, count)) views.push_back(frame.view);
    return views;
  };
  EXPECT_THAT(views_of_worst(2), ::testing::ElementsAre(1, 3));
  EXPECT_THAT(views_of_worst(9), ::testing::ElementsAre(1, 3, 0)) << "one lost nothing";
}

}  // namespace
}  // namespace eval
