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
