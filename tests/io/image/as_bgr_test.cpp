#include "io/image/as_bgr.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace io {
namespace {

TEST(AsBgr, ShowsWhatAnImageWithoutItsAlphaWouldWhateverThatSays) {
  const cv::Mat1b gray = (cv::Mat1b(1, 4) << 0, 10, 128, 255);
  const cv::Mat1b alpha = (cv::Mat1b(1, 4) << 255, 0, 77, 255);
  cv::Mat gray_alpha, colour, colour_alpha;
  cv::merge(std::vector<cv::Mat>{gray, alpha}, gray_alpha);
  EXPECT_EQ(cv::norm(AsBgr(gray_alpha), AsBgr(gray), cv::NORM_INF), 0);
  cv::merge(std::vector<cv::Mat>{gray, 255 - gray, gray / 2}, colour);
  cv::merge(std::vector<cv::Mat>{gray, 255 - gray, gray / 2, alpha}, colour_alpha);
  EXPECT_EQ(cv::norm(AsBgr(colour_alpha), colour, cv::NORM_INF), 0);
}

TEST(AsBgr, MakesGrayAColourOfThreeEqualChannels) {
  const cv::Mat3b bgr = AsBgr(cv::Mat1b(2, 3, std::uint8_t(93)));
  EXPECT_EQ(cv::norm(bgr, cv::Mat3b(2, 3, cv::Vec3b::all(93)), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace io
