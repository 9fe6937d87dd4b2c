#include "eval/planes/segmentation_score.h"

#include <gtest/gtest.h>

namespace eval {
namespace {

// Two pieces make up 75 % of a plane. A third segment on it is mostly another plane's: it is no
// piece, and helps them to no 80 %.
TEST(HooverScore, CallsAPlaneDividedByThePiecesAloneThatAreMostlyItsOwn) {
  Overlap overlap;
  overlap.truth_pixels = {{1, 100}, {2, 80}};
  overlap.machine_pixels = {{10, 40}, {11, 35}, {12, 100}};
  overlap.shared = {{1, {{10, 40}, {11, 35}, {12, 20}}}, {2, {{12, 80}}}};
  const HooverScore apart = ScoreHoover(overlap, 0.8);
  EXPECT_EQ(apart.correct, 1);
  EXPECT_EQ(apart.over, 0);
  EXPECT_EQ(apart.missed, 1);
  overlap.machine_pixels[11] = overlap.shared[1][11] = 45;  // 85 %
  overlap.shared[1][12] = 15, overlap.machine_pixels[12] = 95;
  EXPECT_EQ(ScoreHoover(overlap, 0.8).over, 1);
}

// The same with the roles exchanged: a segment over two planes and a corner of a third.
TEST(HooverScore, CallsASegmentOverTwoPlanesByThoseAloneThatAreMostlyInIt) {
  Overlap overlap;
  overlap.truth_pixels = {{1, 40}, {2, 35}, {3, 100}};
  overlap.machine_pixels = {{10, 100}, {11, 80}};
  overlap.shared = {{1, {{10, 40}}}, {2, {{10, 35}}}, {3, {{10, 20}, {11, 80}}}};
  const HooverScore score = ScoreHoover(overlap, 0.8);
  EXPECT_EQ(score.under, 0);
  EXPECT_EQ(score.correct, 1);
}

}  // namespace
}  // namespace eval
