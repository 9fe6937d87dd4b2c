#include "slam/calibrate/depth_scatter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

namespace slam {
namespace {

/// A slanting wall, 1.1 to 1.8 m.
cv::Mat1f Wall(int width = 640, int height = 480) {
  cv::Mat1f depth_m(height, width);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      depth_m(v, u) = static_cast<float>(1.0 / (0.55 + 0.25 * u / width + 0.1 * v / height));
  return depth_m;
}

/// Errors of unit variance; `window_px` wide squares share `share` of the variance.
cv::Mat1f Errors(cv::Size size, int window_px, double share, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  cv::Mat1f own(size), shared(size);
  for (float& e : own) e = normal(random);
  for (float& e : shared) e = normal(random);
  cv::boxFilter(shared, shared, CV_32F, {window_px, window_px});
  return cv::Mat1f(std::sqrt(1.0 - share) * own + std::sqrt(share) * window_px * shared);
}

/// As the sensors' sources describe them (docs/sensors.md), on light surfaces.
cv::Mat1f ByTimeOfFlight(cv::Mat1f depth_m, std::uint32_t seed) {
  const cv::Mat1f errors = Errors(depth_m.size(), 1, 0.0, seed);
  depth_m.forEach([&](float& z, const int* at) {
    z += (0.0005f + 0.001f * (z - 0.5f)) * errors(at[0], at[1]);
    z = std::round(1000.0f * z) / 1000.0f;
  });
  return depth_m;
}

cv::Mat1f ByStructuredLight(cv::Mat1f depth_m, std::uint32_t seed) {
  const cv::Mat1f errors = Errors(depth_m.size(), 3, 0.9, seed);
  depth_m.forEach([&](float& z, const int* at) {
    const float beyond = z - 0.4f;
    z += (0.0012f + 0.0019f * beyond * beyond) * errors(at[0], at[1]);
    z = 351.3f / std::round(351.3f / z);  // steps of an eighth of a pixel of disparity
  });
  return depth_m;
}

cv::Mat1f ByStereo(cv::Mat1f depth_m, std::uint32_t seed) {
  const cv::Mat1f errors = Errors(depth_m.size(), 7, 0.7, seed);
  depth_m.forEach(
      [&](float& z, const int* at) { z += 0.08f / 21.57f * z * z * errors(at[0], at[1]); });
  return depth_m;
}

std::optional<DepthSensor> Told(const cv::Mat1f& depth_m) {
  DepthScatter scatter;
  scatter.Add(depth_m);
  return scatter.TellSensor();
}

/// The right half of the image in strips of a few pixels' width, 5 cm before and behind it.
cv::Mat1f Cluttered(cv::Mat1f depth_m) {
  for (int u = depth_m.cols / 2; u < depth_m.cols; u += 14)
    depth_m.colRange(u, std::min(u + 7, depth_m.cols)) += 0.05f;
  return depth_m;
}

TEST(DepthScatter, TellsTheSensorOfAWall) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    EXPECT_EQ(Told(ByTimeOfFlight(Wall(), seed)), DepthSensor::kAzure);
    EXPECT_EQ(Told(ByStructuredLight(Wall(), seed)), DepthSensor::kKinect1);
    EXPECT_EQ(Told(ByStereo(Wall(), seed)), DepthSensor::kD435);
  }
}

TEST(DepthScatter, TellsItWhereHalfOfTheImageIsClutter) {
  EXPECT_EQ(Told(ByTimeOfFlight(Cluttered(Wall()), 1)), DepthSensor::kAzure);
  EXPECT_EQ(Told(ByStructuredLight(Cluttered(Wall()), 2)), DepthSensor::kKinect1);
  EXPECT_EQ(Told(ByStereo(Cluttered(Wall()), 3)), DepthSensor::kD435);
}

TEST(DepthScatter, IsInUnitsOfTheFirstKinectsNoiseAtThatDepth) {
  cv::Mat1f depth_m = Wall();
  const cv::Mat1f errors = Errors(depth_m.size(), 1, 0.0, 7);
  const DepthNoise kinect;
  depth_m.forEach([&](float& z, const int* at) {
    z += 2.0f * static_cast<float>(kinect.Sigma(static_cast<double>(z))) * errors(at[0], at[1]);
  });
  DepthScatter scatter;
  scatter.Add(depth_m);
  const DepthScatter::Figures figures = scatter.Measure();
  // The median of the calmer half: of 141 degrees of freedom, 0.67 standard deviations below.
  EXPECT_NEAR(figures.level, 2.0 * (1.0 - 0.67 / std::sqrt(2.0 * 141.0)), 0.02);
  EXPECT_NEAR(figures.alike, 0.0, 0.03);
  EXPECT_EQ(figures.windows, 53u * 40u);
}

TEST(DepthScatter, TellsNothingOfDepthThatIsLikeNoSensors) {
  EXPECT_EQ(Told(Wall()), std::nullopt);  // no noise
  cv::Mat1f white = Wall();               // of the first Kinect's size, but each pixel's own
  const cv::Mat1f errors = Errors(white.size(), 1, 0.0, 8);
  white.forEach([&](float& z, const int* at) {
    z += static_cast<float>(DepthNoise{}.Sigma(static_cast<double>(z))) * errors(at[0], at[1]);
  });
  EXPECT_EQ(Told(white), std::nullopt);
}

TEST(DepthScatter, TellsNothingFromTooFewPixelsAndFromNear) {
  EXPECT_EQ(Told({}), std::nullopt);
  EXPECT_EQ(Told(ByStereo(Wall(240, 180), 1)), std::nullopt);
  EXPECT_EQ(Told(ByStereo(cv::Mat1f(0.5 * Wall()), 1)), std::nullopt);
  DepthScatter scatter;
  for (std::uint32_t seed = 1; seed <= 2; ++seed) scatter.Add(ByStereo(Wall(240, 180), seed));
  EXPECT_EQ(scatter.TellSensor(), DepthSensor::kD435);
}

TEST(DepthScatter, LeavesOutWhatIsNotMeasured) {
  cv::Mat1f depth_m = ByTimeOfFlight(Wall(), 4);
  const float not_measured[] = {0.0f, -1.0f, NAN, INFINITY};
  for (int v = 0; v < depth_m.rows; v += 40)
    for (int u = 0; u < depth_m.cols; u += 40) depth_m(v, u) = not_measured[(u / 40) % 4];
  EXPECT_EQ(Told(depth_m), DepthSensor::kAzure);
}

// Beyond 4 m a device may smooth, or scatter as no model says.
TEST(DepthScatter, TellsTheSensorByWhatIsNearWhateverItMakesOfAHallBehind) {
  const auto with_hall = [](cv::Mat1f depth_m) {
    depth_m.colRange(depth_m.cols / 2, depth_m.cols) = 6.0f;
    return depth_m;
  };
  EXPECT_EQ(Told(with_hall(ByTimeOfFlight(Wall(), 1))), DepthSensor::kAzure);
  EXPECT_EQ(Told(with_hall(ByStructuredLight(Wall(), 2))), DepthSensor::kKinect1);
  EXPECT_EQ(Told(with_hall(ByStereo(Wall(), 3))), DepthSensor::kD435);
  EXPECT_EQ(Told(ByStereo(cv::Mat1f(4.0 * Wall()), 1)), std::nullopt);  // nothing is near
}

}  // namespace
}  // namespace slam
