#include "sim/sensor/report/sensor_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace sim {
namespace {

/// What is printed of a sensor, again from its constants.
struct Published {
  SensorKind kind;
  std::function<double(double z_m, double tilt_rad)> sd_m;
  std::function<double(double z_m)> bias_m, step_m;
};

double Wave(double turns) { return std::sin(2 * M_PI * turns); }

double KinectSd(double z, double tilt) {
  const double grazing = 0.0001 / std::sqrt(z) * std::pow(tilt / (M_PI / 2 - tilt), 2);
  return 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4) + (tilt > M_PI / 3 ? grazing : 0.0);
}

double NoBias(double) { return 0; }
double KinectStep(double z) { return z * z / 351.3; }

const Published kSensors[] = {
    {SensorKind::kKinect1Clean, KinectSd, NoBias, KinectStep},
    {SensorKind::kAzure,
     [](double z, double tilt) {
       return std::min(0.017, (0.0005 + 0.001 * (z - 0.5)) / std::sqrt(std::cos(tilt)));
     },
     [](double z) { return 0.002 * Wave(z / 0.75); }, [](double) { return 0.001; }},
    {SensorKind::kD435, [](double z, double) { return z * z * 0.08 / 21.57; },
     [](double z) { return 21.57 / (21.57 / z + 0.03 * Wave(21.57 / z)) - z; },
     [](double z) { return std::max(0.001, z * z / 32 / 21.57); }}};

TEST(StatedOfASensor, IsWhatIsPublished) {
  for (const Published& published : kSensors) {
    const Sensor sensor(published.kind);
    for (const double z_m : {0.6, 1.0, 1.7, 3.0}) {
      for (const double tilt : {0.0, 0.5, 1.0, 1.1, 1.3}) {
        const double sd_m = published.sd_m(z_m, tilt);
        EXPECT_NEAR(DepthSigma(sensor.depth, z_m, tilt), sd_m, 1e-9 * sd_m)
            << sensor.name << " at " << z_m << " m, " << tilt << " rad";
      }
      EXPECT_NEAR(DepthBias(sensor.depth, z_m), published.bias_m(z_m), 1e-12) << sensor.name;
      EXPECT_NEAR(DepthStep(sensor.depth, z_m), published.step_m(z_m), 1e-12) << sensor.name;
    }
  }
}

TEST(MeasureWalls, MeasuresWhatItStates) {
  const SensorReport report = MeasureWalls(SensorKind::kKinect1Clean);
  EXPECT_EQ(report.by_depth.size(), 9u);
  EXPECT_EQ(report.by_tilt.size(), 6u);
  for (const WallMeasurement& wall : report.by_tilt) {
    EXPECT_EQ(wall.stated_sd_m, DepthSigma(KinectModel{}, wall.z_m, wall.tilt_rad));
    EXPECT_NEAR(wall.sd_m, wall.stated_sd_m, 0.06 * wall.stated_sd_m) << wall.tilt_rad;
  }
  for (const WallMeasurement& wall : report.by_depth) {
    EXPECT_EQ(wall.stated_sd_m, DepthSigma(KinectModel{}, wall.z_m, 0));
    EXPECT_NEAR(wall.sd_m, wall.stated_sd_m, 0.06 * wall.stated_sd_m) << wall.z_m;
    EXPECT_EQ(wall.stated_step_m, KinectStep(wall.z_m));
    EXPECT_NEAR(wall.step_m, wall.stated_step_m, 0.25 * wall.stated_step_m) << wall.z_m;
    EXPECT_NEAR(wall.bias_m, 0.0, 0.1 * wall.stated_step_m) << wall.z_m;
  }
}

}  // namespace
}  // namespace sim
