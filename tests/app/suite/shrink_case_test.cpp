#include "app/suite/shrink_case.h"

#include <gtest/gtest.h>

namespace app {
namespace {

constexpr const char* kAte = "/trajectory/ate_se3/rmse_m";
constexpr const char* kPrecision = "/association/decision/precision";
constexpr const char* kWrong = "/association/decision/fp";
constexpr const char* kTime = "/time_ratio/da";

TEST(FindWorseFigure, TakesTheOneWithTheMostHarmForWhatMatters) {
  const eval::Figures before{{kAte, 0.010}, {kPrecision, 1.0}, {kWrong, 4}, {kTime, 1.0}};
  // 4.1 times the 5 % that matter, 10 times the 0.01, better, and left out.
  const eval::Figures now{{kAte, 0.0122}, {kPrecision, 0.9}, {kWrong, 3}, {kTime, 9.0}};
  const auto worse = FindWorseFigure(before, now);
  ASSERT_TRUE(worse);
  EXPECT_EQ(worse->figure, kPrecision);
  EXPECT_EQ(worse->before, 1.0);
  EXPECT_EQ(worse->now, 0.9);
}

TEST(FindWorseFigure, FindsNothingWhereNoHarmMattersOrAFigureIsUndefined) {
  const eval::Figures before{{kAte, 0.010}, {kPrecision, 1.0}, {kWrong, std::nullopt}};
  const eval::Figures now{{kAte, 0.0104}, {kPrecision, std::nullopt}, {kWrong, 9}};
  EXPECT_FALSE(FindWorseFigure(before, now));
}

}  // namespace
}  // namespace app
