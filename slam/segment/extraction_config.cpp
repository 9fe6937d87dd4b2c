#include "slam/segment/extraction_config.h"

namespace slam {

const std::vector<std::string>& SegmentationNames() {
  static const std::vector<std::string> names{"ours", "ahc"};
  return names;
}

PlaneExtractionConfig ExtractionFor(DepthSensor sensor) {
  PlaneExtractionConfig config;
  config.joining.bend_ratio = ModelOf(sensor).bend_ratio;
  // The wave of time of flight is most of its noise, and parts at two distances lie elsewhere in it.
  if (sensor == DepthSensor::kAzure) config.joining.union_gap_sigmas = 0.4;
  return config;
}

}  // namespace slam
