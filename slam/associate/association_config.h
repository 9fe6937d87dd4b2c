#pragma once

#include "slam/associate/plane_gates.h"
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

}  // namespace slam
