#include "slam/config/config.h"

#include "slam/config/config_fields.h"

namespace slam {

void ShareFacts(Config& config) {
  const PointFeatureConfig& facts = config.point_features;
  config.tracking.pose.virtual_bf_px_m = facts.bf_px_m;
  config.tracking.keyframes.bf_px_m = facts.bf_px_m;
  config.tracking.keyframes.scales = facts.scales;
  config.tracking.projection.bf_px_m = facts.bf_px_m;
  config.tracking.projection.scales = facts.scales;
}

void VisitConfig(Config& config, FieldVisitor& visitor) {
  VisitPoints(config, visitor);
  VisitPlanes(config, visitor);
}

}  // namespace slam
