#include "sim/motion/view.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace sim {
namespace {

std::vector<View> Knots(std::size_t count) {
  std::vector<View> knots;
  for (std::size_t i = 0; i < count; ++i) {
    const auto k = static_cast<double>(i);
    knots.push_back({{k * k, -k, 1.0}, {k, k * k * k, 0.0}, 2.0 * k});
  }
  return knots;
}

TEST(ViewsAlongASpline, AreThoseOfTheStretchTheyLieIn) {
  const std::vector<View> knots = Knots(6);
  const View along = Along(knots, 1.25);
  const View blended = Blend({knots[1], knots[2], knots[3], knots[4]}, 0.25);
  EXPECT_EQ(along.camera_w, blended.camera_w);
  EXPECT_EQ(along.gaze_w, blended.gaze_w);
  EXPECT_EQ(along.roll_deg, blended.roll_deg);
}

// A time that is a whole number of knots only after rounding (204 / 30 s, knots 0.4 s apart) asks
// for the last place while the knot after it is still to come.
TEST(ViewsAlongASpline, AtTheLastPlaceDoNotHangOnWhatIsBehindTheLastKnot) {
  const View longer = Along(Knots(5), 1.0);
  std::vector<View> knots = Knots(4);
  knots.reserve(5);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  knots.push_back({{kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}, kNaN});
  knots.pop_back();
  const View last = Along(knots, 1.0);
  EXPECT_EQ(last.camera_w, longer.camera_w);
  EXPECT_EQ(last.gaze_w, longer.gaze_w);
  EXPECT_EQ(last.roll_deg, longer.roll_deg);
}

}  // namespace
}  // namespace sim
