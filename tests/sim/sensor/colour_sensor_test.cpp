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

TEST(NoisyColour, IsDrawnForEachChannelByItself) {
  const cv::Mat3f radiance(200, 200, cv::Vec3f(0.2F, 0.2F, 0.2F));
  const cv::Mat3b image =
      MeasureColour(radiance, ColourModel{.corner_loss = 0}, PixelNoise(5, 0));
  cv::Mat pixels, covariance, mean;
  image.reshape(1, static_cast<int>(image.total())).convertTo(pixels, CV_64F);
  cv::calcCovarMatrix(pixels, covariance, mean, cv::COVAR_NORMAL | cv::COVAR_ROWS);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) {
      const double correlation =
          covariance.at<double>(i, j) /
          std::sqrt(covariance.at<double>(i, i) * covariance.at<double>(j, j));
      EXPECT_NEAR(correlation, 0.0, 5 / std::sqrt(40000.0));
    }
  }
}

/// Variance of linear light where the mean is `light`: of many pixels, through a gamma of 1 and
/// without the 1/12 of 8 bits.
double LinearVariance(const ColourModel& model, float light) {
  ColourModel linear = model;
  linear.gamma = 1;
  linear.corner_loss = 0;
  const cv::Mat3f radiance(300, 300, cv::Vec3f(light, light, light));
  cv::Scalar mean, sd;
  cv::meanStdDev(MeasureColour(radiance, linear, PixelNoise(6, 1)), mean, sd);
  return (sd[0] * sd[0] - 1.0 / 12) / (255 * 255);
}

// Each alone, at ten times the usual strength, so that 8 bits resolve it; 90 000 pixels: the
// variance is known to 2.4 % at five sigma.
TEST(ShotNoise, GrowsWithTheLightAndReadNoiseDoesNot) {
  const ColourModel shot{.shot_variance = 1.4e-3, .read_sigma = 0};
  EXPECT_NEAR(LinearVariance(shot, 0.5F), 0.5 * 1.4e-3, 0.03 * 0.5 * 1.4e-3);
  EXPECT_NEAR(LinearVariance(shot, 0.1F), 0.1 * 1.4e-3, 0.03 * 0.1 * 1.4e-3);
  const ColourModel read{.shot_variance = 0, .read_sigma = 1e-2};
  EXPECT_NEAR(LinearVariance(read, 0.5F), 1e-4, 0.04 * 1e-4);
  EXPECT_NEAR(LinearVariance(read, 0.1F), 1e-4, 0.04 * 1e-4);
}

TEST(Vignetting, TakesTheStatedShareInTheCornersAndGrowsWithTheSquareOfTheRadius) {
  const cv::Mat3f radiance(121, 161, cv::Vec3f(1.0F, 1.0F, 1.0F));
  ColourModel model = CleanColour();
  model.corner_loss = 0.4;
  model.gamma = 1;
  const cv::Mat3b image = MeasureColour(radiance, model, PixelNoise(5, 0));
  EXPECT_EQ(image(60, 80)[1], 255);
  EXPECT_NEAR(image(0, 0)[1], 255 * 0.6, 1);
  EXPECT_NEAR(image(120, 160)[2], 255 * 0.6, 1);
  EXPECT_NEAR(image(30, 40)[0], 255 * 0.9, 1);  // half-way out
}

}  // namespace
}  // namespace sim
