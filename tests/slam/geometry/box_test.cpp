#include "slam/geometry/box.h"

#include <gtest/gtest.h>

namespace slam {
namespace {

const Box kBox{{10, 20}, {40, 24}};

TEST(Box, HasTheSidesBetweenItsCorners) {
  EXPECT_EQ(kBox.width(), 30.0);
  EXPECT_EQ(kBox.height(), 4.0);
  EXPECT_EQ(kBox.area(), 120.0);
  EXPECT_EQ(kBox.center(), Eigen::Vector2d(25, 22));
}

TEST(Box, IsEmptyUntilItIncludesAPoint) {
  Box box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.area(), 0.0);
  box.Include({3, 4});
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.area(), 0.0);
  box.Include({1, 9});
  EXPECT_EQ(box.min, Eigen::Vector2d(1, 4));
  EXPECT_EQ(box.max, Eigen::Vector2d(3, 9));
}

TEST(Box, ContainsItsBorderAndAMargin) {
  EXPECT_TRUE(kBox.Contains({10, 20}));
  EXPECT_TRUE(kBox.Contains({40, 24}));
  for (const Eigen::Vector2d& outside :
       {Eigen::Vector2d(9, 22), {41, 22}, {25, 19}, {25, 25}}) {
    EXPECT_FALSE(kBox.Contains(outside)) << outside.transpose();
    EXPECT_TRUE(kBox.Contains(outside, 1.0)) << outside.transpose();
  }
}

TEST(Box, SharesWithAnotherTheAreaOfBothOverThatOfEither) {
  const Box half{{10, 20}, {25, 24}}, beside{{50, 20}, {60, 24}}, corner{{25, 22}, {55, 26}};
  EXPECT_DOUBLE_EQ(Iou(kBox, kBox), 1.0);
  EXPECT_DOUBLE_EQ(Iou(kBox, half), 0.5);
  EXPECT_DOUBLE_EQ(Iou(kBox, corner), 30.0 / 210.0);
  EXPECT_DOUBLE_EQ(Iou(corner, kBox), 30.0 / 210.0);
  EXPECT_DOUBLE_EQ(Iou(kBox, beside), 0.0);
  EXPECT_DOUBLE_EQ(Iou(kBox, Box{}), 0.0);
  EXPECT_TRUE(Intersection(kBox, beside).empty());
}

}  // namespace
}  // namespace slam
