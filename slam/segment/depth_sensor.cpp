#include "slam/segment/depth_sensor.h"

namespace slam {
namespace {

DepthNoise AzureNoise() {
  // Noise of a surface that reflects half, at 45 degrees (1.6 mm/m z), and the wave at its
  // peak, in quadrature, to 0.4 mm up to 1.5 m. Pixels share the wave; how many count as one is
  // not to be derived: 32 divided desks best.
  return {.floor_m = 0.0022,
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
      config.max_bend_sigmas = 4.0;  // the wave bends a surface
      config.max_bend_rad = 0.15;
      config.max_warp_sigmas = 0.0;  // it is in the noise
      break;
    case DepthSensor::kD435:
      config.noise = D435Noise();
      config.box_split.enabled = true;  // thin steps are hidden in its noise
      break;
  }
  return config;
}

const std::vector<std::string>& DepthSensorNames() {
  static const std::vector<std::string> names = {"kinect1", "azure", "d435"};
  return names;
}

}  // namespace slam
