#include "eval/export/run_lengths.h"

#include <gtest/gtest.h>

#include <numeric>

namespace eval {
namespace {

using Runs = std::vector<std::uint32_t>;

TEST(RunLengths, GoDownTheColumnsAndBeginWithPixelsThatAreOff) {
  const cv::Mat1b mask = (cv::Mat1b(2, 3) << 1, 0, 1,  //
                          1, 0, 0);
  EXPECT_EQ(RunLengths(mask), (Runs{0, 2, 2, 1, 1}));
}

TEST(RunLengths, OfAnEmptyAndOfAFullMaskAreOneRun) {
  EXPECT_EQ(RunLengths(cv::Mat1b(3, 4, uchar{0})), (Runs{12}));
  EXPECT_EQ(RunLengths(cv::Mat1b(3, 4, uchar{1})), (Runs{0, 12}));
}

// By hand from the format's rule: 5 bits a character, from 48 on, +32 when more follow.
TEST(CompressedRunLengths, AreThoseOfTheRuleByHand) {
  EXPECT_EQ(CompressRunLengths({0}), "0");
  EXPECT_EQ(CompressRunLengths({15}), "?");   // 48 + 15
  EXPECT_EQ(CompressRunLengths({16}), "`0");  // bit 4 is the sign: a second group is needed
  EXPECT_EQ(CompressRunLengths({33}), "Q1");  // 1 + 32 * 1
  EXPECT_EQ(CompressRunLengths({6, 1, 40, 4, 5, 4, 5, 4, 21}), "61X13mN000`0");
  EXPECT_EQ(CompressRunLengths({0, 5, 3, 2}), "053M");  // 2 - 5 = -3
}

}  // namespace
}  // namespace eval
