#include "slam/run/config.h"

#include "slam/run/config_fields.h"

namespace slam {

void ShareFacts(Config& config) {
  config.plane_processing.noise = config.plane_extraction.noise;
}

void VisitConfig(Config& config, FieldVisitor& visitor) {
  VisitPoints(config, visitor);
  VisitDetections(config, visitor);
  VisitExtraction(config, visitor);
  VisitProcessing(config, visitor);
  VisitAssociation(config, visitor);
  VisitMapping(config, visitor);
  VisitLoop(config, visitor);
  ShareFacts(config);
}

}  // namespace slam
