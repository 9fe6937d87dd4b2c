#include "slam/run/config_fields.h"

namespace slam {
namespace {

void VisitGates(PlaneGateConfig& c, FieldVisitor& v) {
  v.Degrees("max_normal_angle_deg", c.max_normal_angle_rad, "(0, 180)", "beta_T, eq6");
  v.Number("max_patch_offset_m", c.max_patch_offset_m, "(0, inf)", "d_T, eq7");
  v.Number("max_edge_point_distance_m", c.max_edge_point_distance_m, "(0, inf)", "d_T', eq8");
  v.Number("min_edge_point_ratio", c.min_edge_point_ratio, "[0, 1)", "R_T, eq8");
}

void VisitRules(AssociationConfig& c, FieldVisitor& v) {
  v.Section("gates", "by parameters alone", [&] { VisitGates(c.gates, v); });
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

void VisitFactors(PlaneConstraintConfig& c, FieldVisitor& v) {
  v.Number("plane_offset_floor_m", c.plane_offset_floor_m, "(0, inf)", "of f_pi");
  v.Degrees("plane_angle_floor_deg", c.plane_angle_floor_rad, "(0, 90)", "of f_pi");
  v.Number("point_plane_sigma_m", c.point_plane_sigma_m, "(0, inf)", "of f_p_pi");
  v.Number("points_per_plane", c.points_per_plane, "(0, inf)",
           "a plane's points weigh no more together");
  v.Number("box_sigma_px", c.box_sigma_px, "(0, inf)", "of f_b_pi");
  v.Number("max_box_gap_px", c.max_box_gap_px, "[0, inf)",
           "a farther box side is not the plane's edge");
  v.Degrees("max_direction_angle_deg", c.max_direction_angle_rad, "(0, 28)",
            "from parallel or a right angle");
  v.Number("max_direction_sigmas", c.max_direction_sigmas, "(0, inf)",
           "the same, by its own uncertainty");
  v.Degrees("direction_sigma_deg", c.direction_sigma_rad, "(0, 90)", "of f_pi_p and f_pi_v");
  v.Number("min_direction_area_m2", c.min_direction_area_m2, "[0, inf)", "of both planes");
  v.Integer("min_direction_observations", c.min_direction_observations, "[1, 100000]",
            "of the map plane");
}

}  // namespace

void VisitAssociation(Config& c, FieldVisitor& v) {
  v.Section("association", "frame planes with map planes",
            [&] { VisitRules(c.association, v); });
  v.Section("plane_constraints", "the plane factors of eq13",
            [&] { VisitFactors(c.plane_constraints, v); });
}

}  // namespace slam
