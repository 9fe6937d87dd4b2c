#include "slam/geometry/sensor_model.h"

#include <gmock/gmock.h>

#include <cmath>

namespace slam {
namespace {

TEST(SensorModel, HasTheNoiseThatItsSourcesState) {
  const DepthNoise kinect = ModelOf(DepthSensor::kKinect1).noise;
  EXPECT_NEAR(kinect.Sigma(1.0), 0.0012 + 0.0019 * 0.36, 1e-12);
  EXPECT_EQ(kinect.Sigma(0.3), 0.0012);
  const DepthNoise d435 = ModelOf(DepthSensor::kD435).noise;
  for (const double z_m : {0.5, 1.0, 2.0, 3.0}) {
    EXPECT_NEAR(d435.Sigma(z_m), z_m * z_m * 0.08 / 21.5645, 0.00025) << z_m;
  }
  const DepthNoise azure = ModelOf(DepthSensor::kAzure).noise;
  for (const double z_m : {0.5, 1.0, 1.5}) {
    EXPECT_NEAR(azure.Sigma(z_m), std::hypot(0.0016 * z_m, 0.002), 0.0004) << z_m;
  }
}

// Sources: docs/planes.md and the data sheets named in sensor_model.h.
TEST(SensorModel, KnowsWhatEachSensorsErrorsHaveInCommon) {
  const SensorModel kinect = ModelOf(DepthSensor::kKinect1),
                    azure = ModelOf(DepthSensor::kAzure), d435 = ModelOf(DepthSensor::kD435);
  // A wave of 2 mm at a metre goes with the distance: it lifts surfaces as wholes. Triangulation has none.
  EXPECT_EQ(azure.bend_ratio, 0.002);
  EXPECT_EQ(azure.unseen_ratio, azure.bend_ratio);
  EXPECT_EQ(kinect.unseen_ratio, 0.0);
  EXPECT_EQ(d435.unseen_ratio, 0.0);
  EXPECT_EQ(kinect.bend_ratio, kKinectBend);
  EXPECT_EQ(d435.bend_ratio, 0.0);
  EXPECT_DOUBLE_EQ(kinect.DepthSigma_m(1.5),
                   std::hypot(kinect.noise.Sigma(1.5), 1.5 * kKinectBend));
  // Windows of 7 x 7 share most of their error, and make near things wider by half a window.
  EXPECT_GT(d435.noise.correlated_px, 0.5 * 49);
  EXPECT_LT(d435.noise.correlated_px, 49);
  EXPECT_EQ(d435.edge_growth_px, 4.0);
  EXPECT_EQ(kinect.edge_growth_px, 1.5);
  EXPECT_EQ(azure.edge_growth_px, 1.5);
}

// Twice as far in, a ray that grazes at 45 degrees has theta^2 / (pi / 2 - theta)^2 = 1.
TEST(DepthNoise, GrowsWithTheSlantAsNguyenFoundAndNotForASurfaceThatIsFaced) {
  const DepthNoise noise;
  EXPECT_DOUBLE_EQ(noise.GrazingFactor(1.0, 1.0), 1.0);
  for (const double z_m : {0.5, 1.0, 2.0}) {
    const auto added_m = [&](double degrees) {
      return (noise.GrazingFactor(z_m, std::cos(degrees * M_PI / 180)) - 1.0) *
             noise.Sigma(z_m);
    };
    EXPECT_NEAR(added_m(45), noise.grazing_m / std::sqrt(z_m), 1e-12);
    EXPECT_NEAR(added_m(60), 4 * added_m(45), 1e-12);
    EXPECT_NEAR(added_m(30), added_m(45) / 4, 1e-12);
    EXPECT_DOUBLE_EQ(added_m(95), added_m(89)) << "nothing is measured beyond";
  }
}

TEST(SensorModel, IsNamedInTheOrderOfItsEnumeration) {
  const std::vector<std::string>& names = DepthSensorNames();
  ASSERT_EQ(names.size(), 3u);
  EXPECT_EQ(names[static_cast<std::size_t>(DepthSensor::kAzure)], "azure");
  EXPECT_EQ(names[static_cast<std::size_t>(DepthSensor::kD435)], "d435");
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(ModelOf(static_cast<DepthSensor>(k)).sensor, static_cast<DepthSensor>(k));
  }
}

// What the stamps do not tell, the points of a moving camera are weighed down by.
TEST(SensorModel, DoubtsTheStampsOnlyOfCamerasThatKnowNothingOfEachOther) {
  EXPECT_GT(ModelOf(DepthSensor::kKinect1).stamp_sigma_s, 0.0);
  for (const DepthSensor together : {DepthSensor::kAzure, DepthSensor::kD435})
    EXPECT_EQ(ModelOf(together).stamp_sigma_s, 0.0)
        << DepthSensorNames().at(static_cast<std::size_t>(together));
}

}  // namespace
}  // namespace slam
