#include "slam/run/config.h"

#include "slam/run/config_fields.h"

namespace slam {

void ShareFacts(Config& config) {
  const PointFeatureConfig& facts = config.point_features;
  config.tracking.pose.virtual_bf_px_m = facts.bf_px_m;
  config.tracking.projection.bf_px_m = facts.bf_px_m;
  config.tracking.projection.scales = facts.scales;
  config.mapping.keyframes.bf_px_m = facts.bf_px_m;
  config.mapping.keyframes.scales = facts.scales;
  config.tracking.keyframes = config.mapping.keyframes;
  config.mapping.triangulation.bf_px_m = facts.bf_px_m;
  config.mapping.triangulation.scales = facts.scales;
  config.mapping.fusion.bf_px_m = facts.bf_px_m;
  config.mapping.fusion.scales = facts.scales;
  config.mapping.bundle.bf_px_m = facts.bf_px_m;
  config.mapping.bundle.scales = facts.scales;
  LoopDetectionConfig& loop = config.loop_closing.detection;
  loop.relocalise = config.tracking.relocalise;
  loop.pose = config.tracking.pose;
  loop.projection = config.tracking.projection;
  config.plane_processing.noise = config.plane_extraction.noise;
  config.plane_constraints.association = config.association;
  config.plane_map.association = config.association;
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
