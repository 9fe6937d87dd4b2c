#include "slam/run/text_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace slam {
namespace {

TEST(FiniteNumberText, IsTheShortestThatReadsBackAndNeverMinusZero) {
  for (const double x : {0.1, 1.0 / 3, -0.0, 1e-300, 123456789.125, 5e-324}) {
    EXPECT_EQ(std::strtod(FiniteNumberText(x).c_str(), nullptr), x);
  }
  EXPECT_EQ(FiniteNumberText(-0.0), "0");
  EXPECT_THROW(FiniteNumberText(std::nan("")), std::invalid_argument);
}

TEST(StampText, KeepsTumsSixDecimalsAndAddsDigitsOnlyWhereNeeded) {
  EXPECT_EQ(StampText(1305031102.175304), "1305031102.175304");
  EXPECT_EQ(StampText(0), "0.000000");
  EXPECT_EQ(StampText(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(StampText(1e-7), "0.0000001");
}

}  // namespace
}  // namespace slam
