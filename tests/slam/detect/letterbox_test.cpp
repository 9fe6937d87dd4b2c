#include "slam/detect/letterbox.h"

#include <gmock/gmock.h>

namespace slam {
namespace {

/// The part of the input that shows the image, as the way back from it says.
cv::Size Scaled(cv::Size image, cv::Size input) {
  const Letterbox letterbox(image, input);
  const Eigen::Vector2d pixel =
      letterbox.ToImage(Eigen::Vector2d(1, 1)) - letterbox.ToImage(Eigen::Vector2d(0, 0));
  return {cvRound(image.width / pixel.x()), cvRound(image.height / pixel.y())};
}

TEST(Letterbox, FillsTheLongerSideAndPadsBelowOrAtTheRight) {
  EXPECT_EQ(Scaled({640, 480}, {416, 416}), cv::Size(416, 312));
  EXPECT_EQ(Scaled({480, 640}, {416, 416}), cv::Size(312, 416));
  EXPECT_EQ(Scaled({640, 480}, {640, 640}), cv::Size(640, 480));
  EXPECT_EQ(Scaled({100, 100}, {640, 320}), cv::Size(320, 320));
  EXPECT_EQ(Scaled({10000, 1}, {32, 32}), cv::Size(32, 1));
  // A ratio in floating point makes 415 of some widths.
  for (int width = 1; width < 3000; ++width) {
    EXPECT_EQ(Scaled({width, 1}, {416, 416}).width, 416) << width;
  }
}

TEST(Letterbox, KeepsColoursAndPadsWithGrey) {
  const cv::Mat3b image(48, 64, cv::Vec3b(10, 20, 30));
  const cv::Mat3b input = Letterbox({64, 48}, {32, 32}).Apply(image);
  ASSERT_EQ(input.size(), cv::Size(32, 32));
  for (int v = 0; v < 32; ++v) {
    for (int u = 0; u < 32; ++u) {
      EXPECT_EQ(input(v, u), v < 24 ? cv::Vec3b(10, 20, 30) : cv::Vec3b(114, 114, 114));
    }
  }
}

// Its coordinates would lead back to other places.
TEST(Letterbox, RefusesAnImageOfAnotherSize) {
  EXPECT_THROW(Letterbox({64, 48}, {32, 32}).Apply(cv::Mat3b(24, 32)), std::invalid_argument);
}

TEST(Letterbox, PutsAPixelWhereItsCoordinatesSay) {
  // A square of 40 pixels, a whole number of input pixels: its edges must fall on theirs.
  cv::Mat3b image(480, 640, cv::Vec3b(0, 0, 0));
  image(cv::Rect(200, 120, 40, 40)).setTo(cv::Vec3b(255, 255, 255));
  const Letterbox letterbox({640, 480}, {320, 320});
  const cv::Mat3b input = letterbox.Apply(image);
  EXPECT_EQ(letterbox.ToImage({100, 60}), Eigen::Vector2d(199.5, 119.5));
  EXPECT_EQ(letterbox.ToImage({120, 80}), Eigen::Vector2d(239.5, 159.5));
  for (int v = 50; v < 90; ++v) {
    for (int u = 90; u < 130; ++u) {
      const bool inside = u >= 100 && u < 120 && v >= 60 && v < 80;
      EXPECT_EQ(input(v, u)[0], inside ? 255 : 0) << u << ' ' << v;
    }
  }
}

TEST(Letterbox, LeadsBackFromCornerToCorner) {
  constexpr double kRoundOff_px = 1e-11;  // coordinates below 2000, a few operations
  for (const cv::Size image : {cv::Size(640, 480), {1280, 720}, {333, 777}, {31, 1999}}) {
    for (const cv::Size input : {cv::Size(640, 640), {416, 416}, {320, 96}}) {
      const Letterbox letterbox(image, input);
      const cv::Size scaled = Scaled(image, input);
      const Eigen::Vector2d first = letterbox.ToImage(Eigen::Vector2d(0, 0));
      EXPECT_LT((first - Eigen::Vector2d(-0.5, -0.5)).norm(), kRoundOff_px);
      // The far corner of the image is that of the part that shows it.
      const Eigen::Vector2d last =
          letterbox.ToImage(Eigen::Vector2d(scaled.width, scaled.height));
      EXPECT_LT((last - Eigen::Vector2d(image.width - 0.5, image.height - 0.5)).norm(),
                kRoundOff_px);
    }
  }
}

}  // namespace
}  // namespace slam
