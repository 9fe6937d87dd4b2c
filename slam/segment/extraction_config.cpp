#include "slam/segment/extraction_config.h"

namespace slam {

PlaneExtractionConfig ExtractionFor(DepthSensor sensor) {
  PlaneExtractionConfig config;
  config.joining.bend_ratio = ModelOf(sensor).bend_ratio;
  return config;
}

}  // namespace slam
