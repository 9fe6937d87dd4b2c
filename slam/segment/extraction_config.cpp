#include "slam/segment/extraction_config.h"

namespace slam {

const std::vector<std::string>& SegmentationNames() {
  static const std::vector<std::string> names{"ours", "ahc"};
  return names;
}

PlaneExtractionConfig ExtractionFor(DepthSensor sensor) {
  PlaneExtractionConfig config;
  config.joining.bend_ratio = ModelOf(sensor).bend_ratio;
  return config;
}

}  // namespace slam
