#include "slam/features/weigh_depths.h"

#include <gtest/gtest.h>

#include "slam/geometry/pose.h"

namespace slam {
namespace {

constexpr double kShared = 2.0;  // sigmas of the sensor, as points share them

PointFeature FeatureWithDepth(const Eigen::Vector2d& u_px, double depth_m) {
  PointFeature feature;
  feature.u_px = u_px;
  feature.depth_m = depth_m;
  return feature;
}

TEST(WeighDepths, ACameraThatStandsStillLeavesTheSensorsOwnError) {
  const SensorModel sensor;
  std::vector<PointFeature> features{FeatureWithDepth({100, 80}, 0.8),
                                     FeatureWithDepth({300, 200}, 0.0),
                                     FeatureWithDepth({500, 400}, 3.0)};
  WeighDepths(sensor, Camera{}, {}, features);
  for (const PointFeature& f : {features[0], features[2]}) {
    EXPECT_NEAR(f.depth_sigma_m,
                kShared * std::hypot(sensor.noise.Sigma(f.depth_m), kKinectBend * f.depth_m),
                1e-12);
  }
  EXPECT_EQ(features[1].depth_sigma_m, 0.0);
}

// The points share the error of the stamps, so their mean must be as unsure of it as one of them:
// the sigma of each is what the stamps' error moves it by, times the root of their number.
TEST(WeighDepths, ManyPointsAreNoSurerOfTheStampsThanOneIs) {
  SensorModel exact;
  exact.noise = {.floor_m = 1e-9, .quadratic_per_m = 0.0};
  exact.bend_ratio = 0.0;
  exact.stamp_sigma_s = 0.004;
  const Camera camera;
  UncertainSpeed speed;
  speed.mean << 0.3, -0.2, 0.5, 0.4, -0.6, 0.9;
  for (const int n : {1, 9, 100}) {
    std::vector<PointFeature> features;
    for (int i = 0; i < n; ++i) features.push_back(FeatureWithDepth({40.0 + 5 * i, 300}, 1.4));
    WeighDepths(exact, camera, speed, features);
    for (const PointFeature& f : features) {
      const Eigen::Vector3d x_c = camera.Backproject(f.u_px, f.depth_m);
      const Vector6d early = exact.stamp_sigma_s * speed.mean;
      const double moved_m = 0.5 * ((Exp(early) * x_c).z() - (Exp(-early) * x_c).z());
      EXPECT_NEAR(f.depth_sigma_m, std::sqrt(n) * std::abs(moved_m), 1e-3 * f.depth_sigma_m);
    }
  }
}

TEST(WeighDepths, WhatIsNotKnownOfTheSpeedCountsAsSpeed) {
  const SensorModel sensor;
  UncertainSpeed moving, unknown;
  moving.mean[2] = 0.5;
  unknown.covariance(2, 2) = 0.25;
  std::vector<PointFeature> one{FeatureWithDepth({320, 240}, 1.0)}, other = one;
  WeighDepths(sensor, Camera{}, moving, one);
  WeighDepths(sensor, Camera{}, unknown, other);
  EXPECT_DOUBLE_EQ(one[0].depth_sigma_m, other[0].depth_sigma_m);
  EXPECT_GT(one[0].depth_sigma_m, kShared * sensor.DepthSigma_m(1.0));
}

TEST(WeighDepths, ADeviceThatTakesBothImagesAtOnceKnowsNoStamps) {
  UncertainSpeed fast;
  fast.mean.setOnes();
  std::vector<PointFeature> features{FeatureWithDepth({10, 10}, 2.0)};
  const SensorModel sensor = ModelOf(DepthSensor::kD435);
  WeighDepths(sensor, Camera{}, fast, features);
  EXPECT_DOUBLE_EQ(features[0].depth_sigma_m, kShared * sensor.DepthSigma_m(2.0));
}

}  // namespace
}  // namespace slam
