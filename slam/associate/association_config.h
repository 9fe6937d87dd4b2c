#pragma once

#include "slam/associate/plane_gates.h"
#include "slam/base/field_visitor.h"
#include "slam/pose/pose_prior.h"

namespace slam {

/// How planes are associated.
enum class AssociationRule {
  kIntegrated,  ///< parameters with their uncertainty, overlap, boxes, class belief, rank test
  kParameters   ///< eq6 and (eq7 or eq8) alone, nearest offset: what common systems do
};

/// Everything that association of planes, points and boxes depends on.
struct AssociationConfig {
  AssociationRule rule = AssociationRule::kIntegrated;
  PlaneGateConfig gates;  ///< the parameter rule's; its angle also bounds the integrated rule

  PosePrior prior;
  // Errors of a measured or a mapped plane that do not average out (calibration, quantisation).
  double offset_floor_m = 0.0012;  ///< domain (0, inf)
  double angle_floor_rad = 0.006;  ///< domain (0, inf)

  double max_chi2 = 16.3;     ///< 99.9 % of chi-square with 3 degrees of freedom
  double new_chi2 = 36.0;     ///< above: certainly another plane; between the two: no decision
  double min_overlap = 0.25;  ///< share of the smaller footprint that must be common; (0, 1)
  double min_margin = 4.0;    ///< in -2 log likelihood: nearer candidates are ambiguous
  double overlap_weight = 8.0;  ///< -2 log likelihood of no overlap at all between equal planes
  double iou_weight = 4.0;      ///< -2 log likelihood of boxes that do not meet
  double min_class_odds = 0.1;  ///< that two landmarks share a class; below: they are two
  double max_extension_gap_m = 0.15;  ///< an open surface may go on this far from what was seen
  double min_open_area_m2 = 0.05;     ///< of a map plane that may be seen to extend

  double rank_alpha = 0.01;         ///< two-sided level of the rank test; (0, 1)
  int min_rank_points = 6;          ///< smaller samples are not tested
  double max_point_plane_m = 0.02;  ///< a map point nearer to a frame plane may lie on it
};

inline void VisitFields(AssociationConfig& c, FieldVisitor& v) {
  v.Section("gates", "by parameters alone", c.gates);
  v.Number("pose_sigma_m", c.prior.sigma_m, "(0, inf)", "of the predicted pose");
  v.Degrees("pose_sigma_deg", c.prior.sigma_rad, "(0, 90)", "of the predicted pose");
  v.Number("offset_floor_m", c.offset_floor_m, "(0, inf)", "error that does not average out");
  v.Degrees("angle_floor_deg", c.angle_floor_rad, "(0, 90)", "error that does not average out");
  v.Number("max_chi2", c.max_chi2, "(0, inf)", "of a match, 3 degrees of freedom");
  v.Number("new_chi2", c.new_chi2, "(0, inf)", "above: certainly another plane");
  v.Number("min_overlap", c.min_overlap, "(0, 1)", "share of the smaller footprint");
  v.Number("min_margin", c.min_margin, "[0, inf)",
           "nearer candidates are ambiguous, -2 log likelihood");
  v.Number("overlap_weight", c.overlap_weight, "[0, inf)", "of no overlap, -2 log likelihood");
  v.Number("iou_weight", c.iou_weight, "[0, inf)", "of boxes apart, -2 log likelihood");
  v.Number("max_extension_gap_m", c.max_extension_gap_m, "[0, inf)",
           "an open surface may go on this far");
  v.Number("min_open_area_m2", c.min_open_area_m2, "[0, inf)", "of a plane that may extend");
  v.Number("rank_alpha", c.rank_alpha, "(0, 1)",
           "two-sided level of the rank test, eq9 to eq12");
  v.Integer("min_rank_points", c.min_rank_points, "[1, 100000]",
            "smaller samples are not tested");
  v.Number("max_point_plane_m", c.max_point_plane_m, "(0, inf)",
           "of a map point on a frame plane");
}

}  // namespace slam
