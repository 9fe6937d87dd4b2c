#include <gmock/gmock.h>

#include "tests/support/stream_run.h"

namespace slam {
namespace {

/// Half a swing of the hand, to and fro `laps` times, the clock going on.
std::vector<RecordedFrame> ToAndFro(int laps) {
  constexpr int kHalfSwing = 30;
  std::vector<RecordedFrame> stream;
  for (int i = 0; i < laps * kHalfSwing; ++i) {
    const int lap = i / kHalfSwing, at = i % kHalfSwing;
    RecordedFrame frame =
        Clean()[static_cast<std::size_t>(lap % 2 == 0 ? at : kHalfSwing - 1 - at)];
    frame.index = i;
    frame.timestamp_s = 100.0 + i / 30.0;
    stream.push_back(frame);
  }
  return stream;
}

// Fails when a place that is known makes keyframes or points again.
TEST(LongRun, OverKnownGroundAddsNeitherKeyframesNorPoints) {
  RunOptions options;
  options.variant = Variant::kPoints;
  const Ran some = RunStream(ToAndFro(2), options), many = RunStream(ToAndFro(8), options);
  EXPECT_EQ(many.outcome.tracked, 8 * 30);
  EXPECT_LE(many.outcome.keyframes, some.outcome.keyframes + 1);
  EXPECT_LE(many.outcome.map_points, 1.1 * some.outcome.map_points);
}

}  // namespace
}  // namespace slam
