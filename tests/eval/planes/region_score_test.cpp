#include "eval/planes/region_score.h"

#include <gtest/gtest.h>

namespace eval {
namespace {

/// A frame in which a true plane of 2,000 pixels may be seen, and one segment of as many.
FrameEvidence FrameOf(bool shows_truth) {
  static const TruthPlane plane = [] {
    TruthPlane made;
    made.id = 1;
    made.scored = true;
    return made;
  }();
  FrameEvidence e;
  if (shows_truth) {
    SeenPlane seen;
    seen.plane = &plane;
    seen.pixels = 2000;
    seen.counted = true;
    e.truth.planes = {seen};
  }
  RunFramePlane segment;
  segment.pixels = 2000;
  e.planes = {segment};
  e.truth_of[0] = shows_truth ? 1 : 0;
  e.pairs = LabelPairs{{{shows_truth ? 1 : 0, 1}, 2000}};
  return e;
}

// Of a frame that shows noise alone EVOPS has nothing right, and it counts.
TEST(RegionScorer, CountsFramesOfNoiseAloneForEvops) {
  RegionScorer right, half;
  right.Add(FrameOf(true));
  half.Add(FrameOf(true));
  half.Add(FrameOf(false));
  EXPECT_DOUBLE_EQ(right.Score()->evops.precision, 1.0);
  EXPECT_DOUBLE_EQ(half.Score()->evops.precision, 0.5);
  EXPECT_DOUBLE_EQ(half.Score()->evops.noise_ratio, 0.5);
  // One of nothing, in which nothing was found, does not; it does for the counts a frame.
  FrameEvidence nothing;
  nothing.pairs = LabelPairs{{{0, 0}, 4000}};
  half.Add(nothing);
  EXPECT_DOUBLE_EQ(half.Score()->evops.precision, 0.5);
  EXPECT_DOUBLE_EQ(half.Score()->machine, 2.0 / 3);
}

}  // namespace
}  // namespace eval
