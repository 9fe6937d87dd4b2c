#include "io/stamp_unit.h"

#include <gtest/gtest.h>

namespace io {
namespace {

TEST(MedianStep, IsOfStampsInTheOrderOfTime) {
  EXPECT_EQ(MedianStep({5, 1, 2, 3}), 1.0);
  EXPECT_EQ(MedianStep({1, 2, 4}), 2.0);
}

TEST(MedianStep, NeedsThreeStamps) {
  EXPECT_FALSE(MedianStep({}));
  EXPECT_FALSE(MedianStep({1, 2}));
}

TEST(CanBeSeconds, HoldsForAnyClockThatCountsThem) {
  EXPECT_TRUE(CanBeSeconds({}));
  EXPECT_TRUE(CanBeSeconds({1305031102.1, 1305031102.2, 1305031102.3}));
  EXPECT_TRUE(CanBeSeconds({0, 900, 1800}));
  EXPECT_TRUE(CanBeSeconds({0, 0.1, 0.2, 3600}));  // a pause
}

TEST(CanBeSeconds, DoesNotHoldForSmallerUnits) {
  EXPECT_FALSE(CanBeSeconds({1305031102175}));
  EXPECT_FALSE(CanBeSeconds({0, 1000, 2000}));  // 1 Hz in milliseconds
  EXPECT_FALSE(CanBeSeconds({33e6, 66e6, 99e6}));
}

}  // namespace
}  // namespace io
