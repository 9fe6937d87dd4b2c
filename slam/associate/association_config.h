#pragma once

#include <string>
#include <vector>

#include "slam/associate/plane_gates.h"
#include "slam/base/chi_square.h"
#include "slam/base/field_visitor.h"

namespace slam {

/// How planes are associated.
enum class AssociationRule {
  kIntegrated,  ///< parameters with their uncertainty, overlap, boxes, class belief, rank test
  kParameters,  ///< eq6 and (eq7 or eq8) alone, nearest offset
  kManhattanSlam,  ///< as ManhattanSLAM's program decides (nearest_rules.h) ...
  kPlanarSlam,     ///< ... PlanarSLAM's ...
  kSpSlam          ///< ... and SP-SLAM's
};

/// Names of the rules, in their order, as settings and run.json have them.
inline const std::vector<std::string>& AssociationRuleNames() {
  static const std::vector<std::string> names{"integrated", "parameters", "manhattan-slam",
                                              "planar-slam", "sp-slam"};
  return names;
}

/// Everything that association of planes, points and boxes depends on.
struct AssociationConfig {
  AssociationRule rule = AssociationRule::kIntegrated;
  PlaneGateConfig gates;  ///< of kParameters; its angle also bounds the integrated rule

  double offset_floor_m = 0.0012;
  double angle_floor_rad = 0.006;

  double max_chi2 = kChi2Of3At999;
  bool recheck = true;
  double new_chi2 = 36.0;       // 99.99999 % of chi-square with 3 degrees of freedom
  double min_overlap = 0.25;    // balances matches of planes seen in part against false ones
  double min_margin = 4.0;      // the better answer is e^2, or 7 times, as likely as the next
  double overlap_weight = 8.0;  // no overlap makes a match e^4, or 55 times, less likely
  double iou_weight = 4.0;      // boxes that do not meet make it e^2 times less likely
  double min_class_odds = 0.1;

  double rank_alpha = 0.01;
  int min_rank_points = 6;
  double max_point_plane_m = 0.02;
};

inline void VisitFields(AssociationConfig& c, FieldVisitor& v) {
  v.Named(
      "rule", c.rule, AssociationRuleNames(),
      "that of this project; bounds on parameters; what peers' programs do. The keys but gates "
      "are the first one's");
  v.Section("gates", "bounds on the parameters of a pair of planes", c.gates);
  v.Number("offset_floor_m", c.offset_floor_m, "(0, inf)",
           "error of a plane's offset that does not average out (calibration, quantisation)");
  v.Degrees("angle_floor_deg", c.angle_floor_rad, "(0, 90)",
            "error of a plane's normal that does not average out (calibration, quantisation)");
  v.Number(
      "max_chi2", c.max_chi2, "(0, inf)",
      "largest chi-square of offset and slopes (3 degrees of freedom) of one surface; a match "
      "may cost so much and overlap_weight in all");
  v.Flag(
      "recheck", c.recheck,
      "matches are tested once more at the optimised pose, and taken back beyond max_chi2 or "
      "below min_overlap");
  v.Number(
      "new_chi2", c.new_chi2, "(0, inf)",
      "chi-square from which two planes are certainly two; below it, where they are no match, "
      "there is no decision");
  v.Number("min_overlap", c.min_overlap, "(0, 1)",
           "share of the smaller footprint that both planes must cover");
  v.Number("min_margin", c.min_margin, "[0, inf)",
           "lead, in -2 log likelihood, below which two answers are ambiguous");
  v.Number("overlap_weight", c.overlap_weight, "[0, inf)",
           "cost, in -2 log likelihood, of footprints that do not overlap at all");
  v.Number("iou_weight", c.iou_weight, "[0, inf)",
           "cost, in -2 log likelihood, of boxes that do not meet");
  v.Number("min_class_odds", c.min_class_odds, "(0, 1]",
           "odds that two map planes share a class, below which they are two surfaces");
  v.Number("rank_alpha", c.rank_alpha, "(0, 1)",
           "two-sided significance level of the rank test, eq9 to eq12");
  v.Integer("min_rank_points", c.min_rank_points, "[1, 100000]",
            "points of each sample below which the rank test is not made");
  v.Number("max_point_plane_m", c.max_point_plane_m, "(0, inf)",
           "largest distance from a frame plane of a map point that lies on it");
}

}  // namespace slam
