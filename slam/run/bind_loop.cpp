#include "slam/run/config_fields.h"

namespace slam {
namespace {

void VisitDetection(LoopDetectionConfig& c, FieldVisitor& v) {
  v.Number("min_likeness_ratio", c.min_likeness_ratio, "[0, inf)",
           "of the least likeness to the keyframe's own neighbours");
  v.Number("radius_factor", c.radius_factor, "(0, inf)",
           "on the search radius around the place's points");
  v.Integer("min_inliers", c.min_inliers, "[4, 100000]", "points that agree on one pose");
  v.Number("base_drift_m", c.base_drift_m, "[0, inf)", "a larger correction is refused ...");
  v.Number("drift_per_m", c.drift_per_m, "[0, inf)", "... beyond this share of the path");
  v.Degrees("base_drift_deg", c.base_drift_rad, "[0, 180)", "the same of the turn");
  v.Degrees("drift_deg_per_m", c.drift_rad_per_m, "[0, 180)", "the same of the turn");
}

}  // namespace

void VisitLoop(Config& config, FieldVisitor& v) {
  LoopClosingConfig& c = config.loop_closing;
  v.Section("loop_closing", "known places recognised and the map drawn together", [&] {
    v.Flag("enabled", c.enabled, "off as in the paper's tables");
    VisitDetection(c.detection, v);
    v.Integer("min_edge_points", c.min_edge_points, "[1, 100000]",
              "that tie two keyframes in the pose graph");
    v.Integer("full_iterations", c.full_iterations, "[0, 1000]",
              "of the full adjustment, each round; 0: none");
  });
}

}  // namespace slam
