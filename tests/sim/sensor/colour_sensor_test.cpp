#include "sim/sensor/colour_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace sim {
namespace {

TEST(CleanColour, IsTheGammaCurveInBlueFirstOrder) {
  const cv::Mat3f radiance(16, 16, cv::Vec3f(1.0F, 0.25F, 0.0F));
  const cv::Mat3b image = MeasureColour(radiance, CleanColour(), PixelNoise(1, 0));
  const int quarter = static_cast<int>(std::lround(255 * std::pow(0.25, 1 / 2.2)));
  EXPECT_EQ(image(0, 0), cv::Vec3b(0, static_cast<uchar>(quarter), 255));
  EXPECT_EQ(image(15, 15), image(8, 8));
}

TEST(NoisyColour, VariesAsShotAndReadNoiseSay) {
  const float light = 0.2F;
  const ColourModel model{.corner_loss = 0};
  const cv::Mat3f radiance(200, 200, cv::Vec3f(light, light, light));
  const cv::Mat3b image = MeasureColour(radiance, model, PixelNoise(5, 0));
  cv::Scalar mean, sd;
  cv::meanStdDev(image, mean, sd);
  const double slope = 255 / 2.2 * std::pow(0.2, 1 / 2.2 - 1);
  const double sigma = slope * std::sqrt(model.shot_variance * 0.2 + 1e-6);
  const double expected = std::sqrt(sigma * sigma + 1.0 / 12);
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(sd[channel], expected, 5 * expected / std::sqrt(2.0 * 40000) + 0.02);
  }
}

TEST(NoisyColour, IsDarkerInTheCorners) {
  const cv::Mat3f radiance(120, 160, cv::Vec3f(0.5F, 0.5F, 0.5F));
  ColourModel model = CleanColour();
  model.corner_loss = 0.12;
  const cv::Mat3b image = MeasureColour(radiance, model, PixelNoise(5, 0));
  EXPECT_LT(image(0, 0)[1], image(60, 80)[1] - 5);
}

}  // namespace
}  // namespace sim
