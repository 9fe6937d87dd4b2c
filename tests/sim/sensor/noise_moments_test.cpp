// Mean, variance, correlation of neighbours and drop-outs of the depth noise at 1e5 independent
// pixels a depth, within five standard errors (false alarm 6e-7) of what the published
// constants and a summed-up distribution say. Seeds are fixed.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/sensor/sensor_measurements.h"

namespace sim {
namespace {

constexpr double kSamples = 1e5;

struct Sample {
  double count = 0, lost = 0, mean = 0, variance = 0, lag1 = 0;
};

/// Of value(z, z of the next pixel) over a wall; one pixel in `stride` x `stride`, so that none
/// shares noise with another but its own neighbour.
template <typename Value>
Sample SampleWall(double z_m, const DepthModel& model, int stride, const Value& value) {
  const Camera camera = NarrowCamera();
  const Rendering wall = SensorView(OneBoard(z_m), camera, model);
  Sample s;
  double sum = 0, next_sum = 0, squares = 0, products = 0;
  for (std::uint64_t frame = 0; s.count + s.lost < kSamples; ++frame) {
    const cv::Mat1d z = MeasureDepth(wall, model, camera, 5, frame);
    for (int v = stride; v + stride < z.rows; v += stride) {
      for (int u = stride; u + stride < z.cols; u += stride) {
        if (!(z(v, u) > 0) || !(z(v, u + 1) > 0)) {
          ++s.lost;
          continue;
        }
        const double a = value(z(v, u)), b = value(z(v, u + 1));
        ++s.count;
        sum += a;
        next_sum += b;
        squares += a * a;
        products += a * b;
      }
    }
  }
  s.mean = sum / s.count;
  s.variance = squares / s.count - s.mean * s.mean;
  s.lag1 = (products / s.count - s.mean * next_sum / s.count) / s.variance;
  return s;
}

double NormalCdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

struct Expected {
  double mean = 0, variance = 0, fourth = 0;  ///< fourth: central moment
};

/// Of a normal variable rounded to whole steps, summed up.
Expected RoundedNormal(double mean, double sd) {
  Expected e;
  const auto low = static_cast<long>(mean - 10 * sd - 2),
             high = static_cast<long>(mean + 10 * sd + 2);
  const auto each = [&](const auto& add) {
    for (long k = low; k <= high; ++k) {
      const double x = static_cast<double>(k);
      add(x, NormalCdf((x + 0.5 - mean) / sd) - NormalCdf((x - 0.5 - mean) / sd));
    }
  };
  each([&](double x, double p) { e.mean += p * x; });
  each([&](double x, double p) {
    e.variance += p * std::pow(x - e.mean, 2);
    e.fourth += p * std::pow(x - e.mean, 4);
  });
  return e;
}

Expected Normal(double mean, double sd) { return {mean, sd * sd, 3 * std::pow(sd, 4)}; }

void ExpectMoments(const Sample& s, const Expected& e) {
  EXPECT_NEAR(s.mean, e.mean, 5 * std::sqrt(e.variance / s.count));
  EXPECT_NEAR(s.variance, e.variance,
              5 * std::sqrt((e.fourth - e.variance * e.variance) / s.count));
}

class NoiseMomentsAt : public testing::TestWithParam<double> {};

// Nguyen, Izadi and Lovell's curve; f b = 585.5 px x 75 mm in steps of 1/8 px. Rounding adds
// 1/12 step^2, which the disparity noise leaves room for.
TEST_P(NoiseMomentsAt, OfTheKinectAreThoseOfItsCurveRoundedToDisparitySteps) {
  const double z = GetParam(), steps = 351.3;
  const double sigma_m = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
  const double sigma_steps = sigma_m * steps / (z * z);
  const double drawn = std::sqrt(std::max(sigma_steps * sigma_steps - 1.0 / 12, 1.0 / 36));
  const Sample s = SampleWall(z, KinectModel{}, 4, [&](double m) { return steps / m; });
  ExpectMoments(s, RoundedNormal(steps / z, drawn));
  EXPECT_EQ(s.lost, 0);
}

// A mean over 3 x 3 shares six of nine draws with its neighbour's.
TEST_P(NoiseMomentsAt, OfTheUnroundedKinectCorrelateByTwoThirds) {
  const double z = GetParam(), steps = 351.3;
  const double sigma_m = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
  const Sample s =
      SampleWall(z, KinectModel{.quantise = false}, 4, [&](double m) { return steps / m; });
  ExpectMoments(s, Normal(steps / z, sigma_m * steps / (z * z)));
  EXPECT_NEAR(s.lag1, 2.0 / 3, 0.016);
}

TEST_P(NoiseMomentsAt, OfTheTimeOfFlightSensorAreWhiteAndRoundedToMillimetres) {
  const double z = GetParam();
  AzureModel model;
  model.session_offset_m = 0;
  if (z > model.max_depth_m) {
    EXPECT_EQ(SampleWall(z, model, 2, [](double m) { return m; }).count, 0);
    return;
  }
  const double sigma_mm = 0.5 + std::max(z - 0.5, 0.0);
  const double bias_mm = 2 * std::sin(2 * M_PI * z / 0.75);
  const double drawn = std::sqrt(sigma_mm * sigma_mm - 1.0 / 12);
  const Sample s = SampleWall(z, model, 2, [](double m) { return 1e3 * m; });
  ExpectMoments(s, RoundedNormal(1e3 * z + bias_mm, drawn));
  EXPECT_NEAR(s.lag1, 0, 0.016);
  EXPECT_EQ(s.lost, 0);
}

// 70 % of the variance is smooth over 7 x 7 pixels, of which neighbours share 42 of 49.
TEST_P(NoiseMomentsAt, OfTheStereoSensorFollowItsDisparity) {
  const double z = GetParam(), focal_baseline = 21.57;
  D435Model model{.baseline_m = 0};  // its blind band is wider than the narrow image
  model.grid_px = model.rounding_m = 0;
  const Sample s = SampleWall(z, model, 8, [&](double m) { return focal_baseline / m; });
  const double disparity = focal_baseline / z;
  ExpectMoments(s, Normal(disparity + 0.03 * std::sin(2 * M_PI * disparity), 0.08));
  EXPECT_NEAR(s.lag1, 0.7 * 42 / 49, 0.016);
  EXPECT_EQ(s.lost, 0);
}

INSTANTIATE_TEST_SUITE_P(Depths, NoiseMomentsAt, testing::Values(0.6, 1.2, 2.3, 4.0));

// The rate of loss in the very corner of two walls at 90 deg is a parameter; all else is sure.
TEST(DropOuts, OfTheTimeOfFlightSensorComeAtTheirRateInCorners) {
  AzureModel model{.lateral_px = 0};
  model.flying_pixels = model.hexagon = false;
  model.multipath_loss = 0.3;
  Scene corner;
  for (const double side : {-1.0, 1.0}) {
    corner.objects.push_back(
        BoxObject(side < 0 ? 1 : 2, "wall", Role::kStructure, {0, 0, 0}, {3, 0.1, 3}));
    Object& wall = corner.objects.back();
    wall.q_wo = Eigen::AngleAxisd(side * M_PI / 4, Eigen::Vector3d::UnitZ());
    // Its front (-y) face ends in the line x = 0, y = 1.5.
    wall.center_w = Eigen::Vector3d(0, 1.5, 0) +
                    wall.q_wo * Eigen::Vector3d(side < 0 ? 1.5 : -1.5, 0.05, 0);
  }
  const Camera camera = NarrowCamera();
  const Rendering view = SensorView(corner, camera, model);
  const int middle = 79;  // 0.5 px from the line, 0.3 mm
  double lost = 0, count = 0;
  for (std::uint64_t frame = 0; frame < 60; ++frame) {
    const cv::Mat1d z = MeasureDepth(view, model, camera, 5, frame);
    for (int v = 0; v < z.rows; ++v) {
      ++count;
      lost += z(v, middle) == 0 ? 1 : 0;
    }
  }
  const double rate = 0.3;
  EXPECT_NEAR(lost / count, rate, 5 * std::sqrt(rate * (1 - rate) / count) + 0.02 * rate);
}

}  // namespace
}  // namespace sim
