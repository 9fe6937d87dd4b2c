#include "io/number_text.h"

#include <gtest/gtest.h>

namespace io {
namespace {

TEST(NumberText, IsTheShortestThatReadsBack) {
  EXPECT_EQ(NumberText(0.1), "0.1");
  EXPECT_EQ(NumberText(-0.0), "-0");
  for (const double x : {0.1, 1.0 / 3, 1e-300, 123456789.125, 5e-324}) {
    EXPECT_EQ(ParseNumber(NumberText(x)), x);
  }
}

TEST(ParseNumber, TakesTheWholeTextOrNothing) {
  EXPECT_EQ(ParseNumber("+1.5e3"), 1500.0);
  EXPECT_EQ(ParseNumber("-7"), -7.0);
  for (const char* text : {"", "+", "1.5m", " 1", "1 ", "1,5", "nan", "inf", "1e999", "0x10"}) {
    EXPECT_EQ(ParseNumber(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace io
