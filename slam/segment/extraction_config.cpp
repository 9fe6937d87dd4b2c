#include "slam/segment/extraction_config.h"

namespace slam {

PlaneExtractionConfig ExtractionFor(DepthSensor sensor) {
  PlaneExtractionConfig config;
  switch (sensor) {
    case DepthSensor::kKinect1:
      break;
    case DepthSensor::kAzure:
      config.joining.bend_ratio = 0.002;  // its wave: 2 mm at 1 m (ModelOf)
      break;
    case DepthSensor::kD435:
      config.joining.bend_ratio = 0.0;  // not known; its noise hides it
      config.box_split.enabled = true;  // thin steps are hidden in its noise
      break;
  }
  return config;
}

}  // namespace slam
