#include "slam/input/repeated_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slam {
namespace {

using ::testing::ElementsAre;

/// Which of these images, told apart by a number, are taken for repeats.
std::vector<bool> Repeated(const std::vector<int>& images) {
  RepeatedImages repeated;
  std::vector<bool> found;
  for (const int image : images) {
    RecordedFrame frame;
    frame.bgr = cv::Mat3b(4, 6, cv::Vec3b(1, 2, static_cast<unsigned char>(image)));
    frame.depth_m = cv::Mat1f(4, 6, 1.0f);
    found.push_back(repeated.Repeats(frame));
  }
  return found;
}

TEST(RepeatedImages, AreFoundAsOftenAsADriverGivesThem) {
  EXPECT_THAT(Repeated({1, 1, 2, 2, 3, 3, 4, 4}),
              ElementsAre(false, true, false, true, false, true, false, true));
  EXPECT_THAT(Repeated({1, 1, 1, 2, 2, 2}), ElementsAre(false, true, true, false, true, true));
  EXPECT_THAT(Repeated({1, 2, 1, 2}), ElementsAre(false, false, false, false));
}

TEST(RepeatedImages, AreAWorldAtRestWhenTheyComeMoreOften) {
  EXPECT_THAT(Repeated({1, 1, 1, 1}), ElementsAre(false, true, true, false));
}

TEST(RepeatedImages, DifferInDepthAlone) {
  RepeatedImages repeated;
  RecordedFrame frame;
  frame.bgr = cv::Mat3b(4, 6, cv::Vec3b(1, 2, 3));
  frame.depth_m = cv::Mat1f(4, 6, 1.0f);
  EXPECT_FALSE(repeated.Repeats(frame));
  frame.depth_m = frame.depth_m.clone();
  frame.depth_m(2, 3) = 1.001f;
  EXPECT_FALSE(repeated.Repeats(frame));
  EXPECT_EQ(repeated.count(), 0);
}

}  // namespace
}  // namespace slam
