#include "slam/geometry/sensor_model.h"

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
          .quadratic_per_m = 0.08 / (430.0 * 0.05015),  // px / (px m), see ModelOf
          .nearest_m = 0.0,
          .grazing_m = 0.0,
          .correlated_px = 35.0};
}

}  // namespace

SensorModel ModelOf(DepthSensor sensor) {
  SensorModel model;
  model.sensor = sensor;
  switch (sensor) {
    case DepthSensor::kKinect1:
      break;
    case DepthSensor::kAzure:
      model.noise = AzureNoise();
      model.bend_ratio = 0.002;  // its wave: 2 mm at 1 m
      model.unseen_ratio = model.bend_ratio;
      model.stamp_sigma_s = 0.0;  // one trigger for both cameras
      break;
    case DepthSensor::kD435:
      model.noise = D435Noise();
      model.edge_growth_px = 4.0;  // half of its 7 x 7 window, and what a pixel is wide
      model.bend_ratio = 0.0;      // not known; its noise hides it
      model.stamp_sigma_s = 0.0;   // one clock for both cameras
      break;
  }
  return model;
}

const std::vector<std::string>& DepthSensorNames() {
  static const std::vector<std::string> names = {"kinect1", "azure", "d435"};
  return names;
}

}  // namespace slam
