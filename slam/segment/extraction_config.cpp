#include "slam/segment/extraction_config.h"

namespace slam {

PlaneExtractionConfig ExtractionFor(DepthSensor sensor) {
  PlaneExtractionConfig config;
  config.joining.bend_ratio = ModelOf(sensor).bend_ratio;
  config.box_split.enabled = sensor == DepthSensor::kD435;  // its noise hides thin steps
  return config;
}

}  // namespace slam
