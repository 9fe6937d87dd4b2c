#include "slam/base/degrees.h"

#include <gtest/gtest.h>

#include <numbers>

namespace slam {
namespace {

TEST(Degrees, AreThoseOfTheAngle) {
  EXPECT_EQ(RadiansOf(180), std::numbers::pi);
  EXPECT_EQ(DegreesOf(std::numbers::pi), 180);
  EXPECT_EQ(DegreesOf(0), 0);
}

TEST(Degrees, ReadBackToTheSameRadiansWhereFifteenDigitsDoNot) {
  for (const double radians : {0.1745, 0.17, 0.09, 0.05, 0.006, 0.26}) {
    EXPECT_EQ(RadiansOf(DegreesOf(radians)), radians) << radians;
  }
}

TEST(Degrees, HaveNoMoreDigitsThanAFileGave) {
  for (const double degrees : {30.0, 0.1, 7.3, 1.0 / 3, 89.999}) {
    EXPECT_EQ(RadiansOf(DegreesOf(RadiansOf(degrees))), RadiansOf(degrees)) << degrees;
  }
  EXPECT_EQ(DegreesOf(RadiansOf(30)), 30);
  EXPECT_EQ(DegreesOf(RadiansOf(0.1)), 0.1);
  EXPECT_EQ(DegreesOf(RadiansOf(7.3)), 7.3);
}

}  // namespace
}  // namespace slam
