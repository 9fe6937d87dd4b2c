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

}  // namespace
}  // namespace app
