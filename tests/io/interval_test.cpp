#include "io/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace io {
namespace {

TEST(Interval, KnowsItsEndsAndRefusesNotANumber) {
  const Interval half("(0, 1]");
  EXPECT_FALSE(half.Contains(0));
  EXPECT_TRUE(half.Contains(1e-300));
  EXPECT_TRUE(half.Contains(1));
  EXPECT_FALSE(half.Contains(std::nan("")));
  const Interval open("[0, inf)");
  EXPECT_TRUE(open.Contains(0));
  EXPECT_FALSE(open.Contains(std::numeric_limits<double>::infinity()));
}

TEST(Interval, OfTwoNumbersHoldsBothAndSaysSo) {
  const Interval sizes(1e-5, 1000000);
  EXPECT_TRUE(sizes.Contains(1e-5) && sizes.Contains(1000000));
  EXPECT_FALSE(sizes.Contains(0) || sizes.Contains(1000000.5));
  EXPECT_EQ(sizes.text(), "[1e-05, 1000000]");
}

TEST(Interval, RefusesATextThatIsNone) {
  for (const char* text : {"0..1", "", "(0 1)", "(a, 1)", "0, 1"}) {
    EXPECT_THROW(Interval{text}, std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace io
