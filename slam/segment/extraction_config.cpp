#include "slam/segment/extraction_config.h"

namespace slam {

PlaneExtractionConfig ExtractionFor(DepthSensor sensor) {
  PlaneExtractionConfig config;
  switch (sensor) {
    case DepthSensor::kKinect1:
      break;
    case DepthSensor::kAzure:
      config.max_bend_sigmas = 4.0;  // the wave bends a surface
      config.max_bend_rad = 0.15;
      config.max_warp_sigmas = 0.0;  // it is in the noise
      break;
    case DepthSensor::kD435:
      config.box_split.enabled = true;  // thin steps are hidden in its noise
      break;
  }
  return config;
}

}  // namespace slam
