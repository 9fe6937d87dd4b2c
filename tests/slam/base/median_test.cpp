#include "slam/base/median.h"

#include <gtest/gtest.h>

namespace slam {
namespace {

TEST(Medians, AreTheValueInTheMiddleWhateverTheOrder) {
  for (const std::vector<int>& values :
       {std::vector{1, 2, 7}, std::vector{7, 1, 2}, std::vector{2, 7, 1}}) {
    EXPECT_EQ(LowerMedian(values), 2);
    EXPECT_EQ(UpperMedian(values), 2);
  }
  EXPECT_EQ(LowerMedian(std::vector{3.5}), 3.5);
  EXPECT_EQ(UpperMedian(std::vector{3.5}), 3.5);
}

TEST(Medians, AreEitherOfTheTwoInTheMiddle) {
  EXPECT_EQ(LowerMedian(std::vector{8, 1, 3, 2}), 2);
  EXPECT_EQ(UpperMedian(std::vector{8, 1, 3, 2}), 3);
  EXPECT_EQ(LowerMedian(std::vector{5, 4}), 4);
  EXPECT_EQ(UpperMedian(std::vector{5, 4}), 5);
}

}  // namespace
}  // namespace slam
