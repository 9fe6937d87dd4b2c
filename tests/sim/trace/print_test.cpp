#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "sim/sensor/colour_sensor.h"
#include "sim/trace/frame_renderer.h"
#include "sim/trace/prints/print.h"
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

/// How far a view moved by half a pixel is from what lies between the pixels, as a
/// share of the contrast. Both are smoothed over 1.2 px first: what is finer than two pixels
/// may differ, but an unfiltered print folds it into coarse patterns that jump about.
double Flicker(const cv::Mat& here, const cv::Mat& moved) {
  cv::Mat a, b, contrast, none, flicker;
  here.convertTo(a, CV_64F);
  moved.convertTo(b, CV_64F);
  cv::GaussianBlur(a, a, cv::Size(9, 9), 1.2);
  cv::GaussianBlur(b, b, cv::Size(9, 9), 1.2);
  const int count = a.cols - 3;
  const auto from = [&](int u) { return a.colRange(u, u + count); };
  const cv::Mat expected = (9.0 * (from(1) + from(2)) - (from(0) + from(3))) / 16.0;  // cubic
  cv::meanStdDev(a, none, contrast);
  cv::meanStdDev(cv::Mat(b.colRange(1, 1 + count) - expected), none, flicker);
  return flicker.at<double>(0) / contrast.at<double>(0);
}

/// The same board with its print looked up at each pixel's centre alone.
cv::Mat UnfilteredBoard(Print print, double z_m, double shift_m) {
  const Camera camera;
  const Material material = OneBoard(z_m, 4.0, print).objects[0].faces[2];
  std::vector<float> x_m, y_m;
  for (int u = 0; u < camera.width; ++u) {
    x_m.push_back(static_cast<float>(2.0 + z_m * camera.Ray(u, 0).x() + shift_m));
  }
  for (int v = camera.height - 1; v >= 0; --v) {
    y_m.push_back(static_cast<float>(2.0 - z_m * camera.Ray(0, v).y()));
  }
  const auto colours = Reflectance(material, Eigen::Vector2f(4.0F, 4.0F), {x_m, y_m});
  cv::Mat1d board(camera.height, camera.width);
  std::size_t i = 0;
  for (int v = camera.height - 1; v >= 0; --v) {
    for (int u = 0; u < camera.width; ++u) {
      board(v, u) = static_cast<double>(colours[i++][1]);
    }
  }
  return board;
}

constexpr double kFar_m = 1.7;

/// Keys repeat every 19 mm with gaps finer than a pixel: the hardest case, measured 0.24.
TEST_P(EveryPrint, MovesWithoutFlicker) {
  const double max_share_of_contrast = GetParam() == Print::kKeys ? 0.3 : 0.12;
  const double half_pixel_m = 0.5 * kFar_m / Camera{}.fx;
  const double filtered =
      Flicker(GreyBoard(GetParam(), kFar_m), GreyBoard(GetParam(), kFar_m, half_pixel_m));
  const double unfiltered = Flicker(UnfilteredBoard(GetParam(), kFar_m, 0),
                                    UnfilteredBoard(GetParam(), kFar_m, half_pixel_m));
  EXPECT_LT(filtered, max_share_of_contrast);
  EXPECT_LT(filtered, 0.6 * unfiltered);
  RecordProperty("filtered", std::to_string(filtered));
  RecordProperty("unfiltered", std::to_string(unfiltered));
}

INSTANTIATE_TEST_SUITE_P(Prints, EveryPrint,
                         testing::Values(Print::kWood, Print::kCloth, Print::kText,
                                         Print::kCover, Print::kKeys, Print::kScreen,
                                         Print::kSpeckle));

/// A face of 0.4 x 0.2 m at every second millimetre.
std::vector<Eigen::Array3f> FaceOf(Print print, double richness) {
  Material material{print, {.5, .4, .3}, {.1, .1, .12}, richness, 7};
  std::vector<float> x_m, y_m;
  for (int i = 0; i < 200; ++i) x_m.push_back(0.002F * static_cast<float>(i) + 0.001F);
  for (int i = 0; i < 100; ++i) y_m.push_back(0.002F * static_cast<float>(i) + 0.001F);
  return Reflectance(material, {0.4F, 0.2F}, {x_m, y_m});
}

TEST_P(EveryPrint, IsTheBaseColourWithoutRichnessAndNearlySoWithLittle) {
  const Eigen::Array3f base(.5F, .4F, .3F);
  for (const auto& [richness, most] : {std::pair(0.0, 1e-6F), std::pair(0.03, 0.05F)}) {
    for (const Eigen::Array3f& colour : FaceOf(GetParam(), richness))
      ASSERT_LE((colour - base).abs().maxCoeff(), most) << richness;
  }
  float farthest = 0;
  for (const Eigen::Array3f& colour : FaceOf(GetParam(), 1))
    farthest = std::max(farthest, (colour - base).abs().maxCoeff());
  EXPECT_GT(farthest, 0.1F);
}

TEST(PlainPrint, HasNoCornerAtAll) {
  std::vector<cv::KeyPoint> corners;
  cv::FAST(GreyBoard(Print::kPlain, 1.0), corners, 20);
  EXPECT_TRUE(corners.empty());
}

}  // namespace
}  // namespace sim
