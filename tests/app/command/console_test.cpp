#include "app/console/console.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace app {
namespace {

TEST(Progress, SaysHowLongItStillTakes) {
  EXPECT_EQ(RateText(60, 125, 6.0), ", 10/s, 0:07 left");
  EXPECT_EQ(RateText(10, 110, 10.0), ", 1/s, 1:40 left");
  EXPECT_EQ(RateText(10, 20, 120.0), ", 5/min, 2:00 left");
  EXPECT_EQ(RateText(125, 125, 12.5), ", 10/s");
}

TEST(Progress, SaysNothingOfTheRateTooSoon) {
  EXPECT_EQ(RateText(1, 100, 0.1), "");
  EXPECT_EQ(RateText(0, 100, 5.0), "");
}

TEST(PassProgress, CountsEachPassByItself) {
  testing::internal::CaptureStderr();
  PassProgress progress(false);
  for (const char* pass : {"first look", "slam"}) {
    for (int done = 1; done <= 3; ++done) progress.Update(pass, done, 3);
  }
  progress.End();
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_THAT(told, testing::HasSubstr("first look 3/3"));
  EXPECT_THAT(told, testing::HasSubstr("slam 1/3"));
  EXPECT_THAT(told, testing::HasSubstr("slam 3/3"));
}

}  // namespace
}  // namespace app
