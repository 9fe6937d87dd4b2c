#include "slam/extract/depth_sensor.h"

namespace slam {
namespace {

DepthNoise AzureNoise() {
  // 1.4 mm is the root mean square of a wave of 2 mm, here added in quadrature at 0.5 and 1.5
  // m.
  return {.floor_m = 0.0015,
          .linear_per_m = 0.0006,
          .quadratic_per_m = 0.0,
          .nearest_m = 0.5,
          .grazing_m = 0.00005,
          .correlated_px = 32.0};
}

DepthNoise D435Noise() {
  return {.floor_m = 0.0002,
          .linear_per_m = 0.0,
          .quadratic_per_m = 0.08 / (430.0 * 0.05015),
          .nearest_m = 0.0,
          .grazing_m = 0.0,
          .correlated_px = 35.0};
}

}  // namespace

PlaneExtractionConfig ExtractionFor(DepthSensor sensor) {
  PlaneExtractionConfig config;
  config.sensor = sensor;
  switch (sensor) {
    case DepthSensor::kKinect1:
      break;
    case DepthSensor::kAzure:
      config.noise = AzureNoise();
      break;
    case DepthSensor::kD435:
      config.noise = D435Noise();
      break;
  }
  return config;
}

const std::vector<std::string>& DepthSensorNames() {
  static const std::vector<std::string> names = {"kinect1", "azure", "d435"};
  return names;
}

}  // namespace slam
