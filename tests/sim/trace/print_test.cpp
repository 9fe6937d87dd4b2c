#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "sim/sensor/colour_sensor.h"
#include "sim/trace/frame_renderer.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

cv::Mat GreyBoard(Print print, double z_m, double shift_m = 0.0) {
  const FrameRenderer renderer(OneBoard(z_m, 4.0, print), Camera{});
  Pose T_wc = LookAlongY();
  T_wc.t.x() += shift_m;
  const Rendering rendering = renderer.Render(T_wc);
  const cv::Mat3b colour = MeasureColour(rendering.radiance, CleanColour(), PixelNoise(1, 0));
  cv::Mat grey;
  cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

class EveryPrint : public testing::TestWithParam<Print> {};

/// Corners in each quarter of the image, so that no large part of the surface is bare.
TEST_P(EveryPrint, HasCornersInEveryQuarterFromHalfAMetreToTwo) {
  constexpr int kEnough = 60;  // a quarter image; a tracker keeps about 250 there
  for (const double z_m : {0.5, 1.0, 2.0}) {
    const cv::Mat grey = GreyBoard(GetParam(), z_m);
    for (int quarter = 0; quarter < 4; ++quarter) {
      const cv::Rect part(320 * (quarter % 2), 240 * (quarter / 2), 320, 240);
      std::vector<cv::KeyPoint> corners;
      cv::FAST(grey(part), corners, 20);
      EXPECT_GE(static_cast<int>(corners.size()), kEnough) << z_m << " m, quarter " << quarter;
    }
  }
}

/// Half a pixel of motion must give about the mean of neighbours; a print sampled without a
/// filter gives something else (flicker). Measured on these boards: 0.05 to 0.16 of the
/// contrast; nearest texel without half-sized copies: over 0.5.
TEST_P(EveryPrint, MovesWithoutFlicker) {
  constexpr double kMaxShareOfContrast = 0.25;
  const double z_m = 1.7;
  const cv::Mat here = GreyBoard(GetParam(), z_m);
  const cv::Mat moved = GreyBoard(GetParam(), z_m, 0.5 * z_m / Camera{}.fx);
  cv::Mat a, b, expected, difference;
  here.colRange(0, 639).convertTo(a, CV_64F);
  here.colRange(1, 640).convertTo(b, CV_64F);
  expected = 0.5 * (a + b);
  moved.colRange(0, 639).convertTo(difference, CV_64F);
  difference -= expected;
  cv::Scalar mean, contrast, none, flicker;
  cv::meanStdDev(here, mean, contrast);
  cv::meanStdDev(difference, none, flicker);
  EXPECT_LT(flicker[0], kMaxShareOfContrast * contrast[0]);
}

INSTANTIATE_TEST_SUITE_P(Prints, EveryPrint,
                         testing::Values(Print::kWood, Print::kCloth, Print::kText,
                                         Print::kCover, Print::kKeys, Print::kScreen,
                                         Print::kSpeckle));

TEST(PlainPrint, HasNoCornerAtAll) {
  std::vector<cv::KeyPoint> corners;
  cv::FAST(GreyBoard(Print::kPlain, 1.0), corners, 20);
  EXPECT_TRUE(corners.empty());
}

}  // namespace
}  // namespace sim
