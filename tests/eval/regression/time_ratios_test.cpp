#include "eval/regression/time_ratios.h"

#include <gtest/gtest.h>

#include <limits>

namespace eval {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(TimeRatios, AreThoseOfTheFastestTenthOfTheFrames) {
  Timing timing{{"orb", "da"}, {}, {}};
  for (int i = 0; i < 21; ++i) timing.rows_ms.push_back({4.0 + i, 12.0 + 3 * i});
  EXPECT_DOUBLE_EQ(*TimeRatios(timing).at("/time_ratio/da"), 18.0 / 6.0);
}

TEST(TimeRatios, TellTheSearchForFeaturesOverPlaneExtraction) {
  // Over itself it would be 1 however slow it became.
  const Timing timing{{"orb", "epi"}, {}, {{6.0, 4.0}}};
  EXPECT_DOUBLE_EQ(*TimeRatios(timing).at("/time_ratio/orb"), 1.5);
  EXPECT_DOUBLE_EQ(*TimeRatios(timing).at("/time_ratio/epi"), 4.0 / 6.0);
}

TEST(TimeRatios, LeaveOutFramesWithoutWork) {
  const Timing timing{{"orb", "da"}, {}, {{0.0, 0.0}, {2.0, kNone}, {2.0, 3.0}, {2.0, 0.0}}};
  EXPECT_DOUBLE_EQ(*TimeRatios(timing).at("/time_ratio/da"), 1.5);
}

TEST(TimeRatios, OfWhatDidNotRunAreNotDefined) {
  const Timing timing{{"orb", "da"}, {}, {{2.0, kNone}}};
  EXPECT_EQ(TimeRatios(timing).at("/time_ratio/da"), std::nullopt);
  EXPECT_EQ(TimeRatios(timing).at("/time_ratio/epi"), std::nullopt);
  EXPECT_EQ(TimeRatios({{"da"}, {}, {{2.0}}}).at("/time_ratio/da"), std::nullopt);
}

}  // namespace
}  // namespace eval
