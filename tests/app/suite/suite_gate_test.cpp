#include "app/suite/suite_gate.h"

#include <gtest/gtest.h>

namespace app {
namespace {

// A machine whose /proc/cpuinfo names no model is not every other such machine.
TEST(SuiteGateProcessor, IsTheSameByItsNameUnlessThatIsUnknown) {
  EXPECT_TRUE(IsSameProcessor("Fast 9", "Fast 9"));
  EXPECT_FALSE(IsSameProcessor("Fast 9", "Slow 1"));
  EXPECT_FALSE(IsSameProcessor("unknown", "unknown"));
}

// Each look is a chance of a false alarm, so they share what the gate may have of it.
TEST(SuiteGateLooks, AreOneForTheFirstSeedsAndOneForEachTimeThatTheyAreDoubled) {
  const auto looks = [](int count, int max_count) { return LooksOf({1, count, max_count}); };
  EXPECT_EQ(looks(5, 5), 1);
  EXPECT_EQ(looks(5, 1), 1);
  EXPECT_EQ(looks(5, 6), 2);   // 5, 6
  EXPECT_EQ(looks(5, 10), 2);  // 5, 10
  EXPECT_EQ(looks(3, 30), 5);  // 3, 6, 12, 24, 30
  EXPECT_EQ(looks(1, 64), 7);  // 1, 2, 4, ... 64
}

}  // namespace
}  // namespace app
