#include "slam/run/config_fields.h"

namespace slam {
namespace {

void VisitRefit(RefitConfig& c, FieldVisitor& v) {
  VisitEnum(v, "method", c.method, {"pcl", "weighted", "best"}, "which fit is kept");
  v.Number("max_inlier_sigmas", c.max_inlier_sigmas, "(0, inf)", "distance of an inlier");
  v.Integer("max_sample_points", c.max_sample_points, "[3, 1000000]",
            "given to the robust fit");
  v.Integer("max_iterations", c.max_iterations, "[1, 1000000]", "of the robust fit");
  v.Number("min_improvement_chi2", c.min_improvement_chi2, "[0, inf)",
           "before a re-fit replaces the fit");
  v.Number("max_edge_sigmas", c.max_edge_sigmas, "(0, inf)",
           "distance of an edge point that is kept");
}

void VisitBoxLink(BoxLinkConfig& c, FieldVisitor& v) {
  v.Number("min_iou", c.min_iou, "[0, 1)", "of the plane's rectangle and the box");
  v.Number("min_edge_share", c.min_edge_share, "[0, 1)", "of edge points inside the box");
  v.Number("margin_px", c.margin_px, "[0, inf)", "a box is that much inexact");
  v.Number("min_score", c.min_score, "[0, 1)", "of the detection");
}

void VisitEdgeLines(EdgeLineConfig& c, FieldVisitor& v) {
  v.Integer("max_lines", c.max_lines, "[1, 16]", "of a plane");
  v.Integer("iterations", c.iterations, "[1, 1000000]", "of RANSAC, a line");
  v.Number("max_distance_px", c.max_distance_px, "(0, inf)", "of an inlier from its line");
  v.Number("max_gap_px", c.max_gap_px, "(0, inf)", "between neighbouring inliers");
  v.Number("min_length_px", c.min_length_px, "(0, inf)", "of a line");
  v.Number("min_contour_share", c.min_contour_share, "[0, 1)",
           "of the edge points that a line holds");
  v.Number("inset_px", c.inset_px, "[0, 1]", "boundary pixels lie this far inside the edge");
  v.Number("shared_sigma_px", c.shared_sigma_px, "[0, inf)",
           "error that all points of a line have in common");
  v.Number("doubtful_step_sigmas", c.doubtful_step_sigmas, "[0, inf)",
           "depth step at which a side is doubtful by a pixel");
}

void VisitVertices(VertexConfig& c, FieldVisitor& v) {
  v.Degrees("min_crossing_angle_deg", c.min_crossing_angle_rad, "(0, 90)",
            "of two lines at a corner");
  v.Degrees("max_parallel_angle_deg", c.max_parallel_angle_rad, "(0, 90)", "of opposite sides");
  v.Degrees("max_square_error_deg", c.max_square_error_rad, "(0, 90)",
            "of a corner from a right angle");
  v.Number("max_feet_distance_m", c.max_feet_distance_m, "(0, inf)", "condition 1, eq2");
  v.Number("max_plane_distance_m", c.max_plane_distance_m, "(0, inf)", "condition 2, eq3");
  v.Number("box_margin_px", c.box_margin_px, "[0, inf)",
           "condition 3, outside the box by less");
  v.Number("max_support_distance_px", c.max_support_distance_px, "(0, inf)",
           "farther is extrapolated");
  v.Number("max_extension", c.max_extension, "[0, inf)", "of a side beyond its end");
  v.Number("min_side_m", c.min_side_m, "(0, inf)", "of a rectangle");
  v.Number("min_fill", c.min_fill, "[0, inf)", "visible area over the rectangle's");
  v.Number("max_fill", c.max_fill, "(0, inf)", "the same, at most");
}

void VisitSelect(SelectConfig& c, FieldVisitor& v) {
  v.Number("max_distance_m", c.max_distance_m, "(0, inf)", "centroid from the camera");
  v.Number("min_inlier_ratio", c.min_inlier_ratio, "[0, 1)", "after the re-fit");
  v.Number("max_roughness", c.max_roughness, "[1, inf)",
           "times that of most of the frame's pixels; more are stairs");
  v.Number("max_unstructured_share", c.max_unstructured_share, "(0, 1]",
           "edge points in an unstructured box");
  VisitEnum(v, "structure", c.structure, {"ignored", "partial", "complete"},
            "demand on regular objects");
  v.Number("border_px", c.border_px, "[0, inf)", "width of the image border");
  v.Number("max_border_share", c.max_border_share, "(0, 1]", "complete: edge points there");
  v.Number("max_partial_border_share", c.max_partial_border_share, "(0, 1]",
           "partial: the same");
  v.Number("max_unexplained_share", c.max_unexplained_share, "(0, 1]",
           "partial: edge points without a line");
}

}  // namespace

void VisitProcessing(Config& config, FieldVisitor& v) {
  PlaneProcessingConfig& c = config.plane_processing;
  v.Section("plane_processing", "segments to trusted planes", [&] {
    v.Section("refit", "robust re-fit", [&] { VisitRefit(c.refit, v); });
    v.Section("box_link", "plane and detection", [&] { VisitBoxLink(c.box_link, v); });
    v.Section("edge_lines", "straight edges", [&] { VisitEdgeLines(c.edge_lines, v); });
    v.Section("vertices", "corners", [&] { VisitVertices(c.vertices, v); });
    v.Section("unlinked", "corners without a detection", [&] {
      v.Number("min_contour_share", c.unlinked.min_contour_share, "[0, 1)",
               "of the edge points that a line holds");
      v.Number("min_length_px", c.unlinked.min_length_px, "(0, inf)", "of a line");
      v.Degrees("max_parallel_angle_deg", c.unlinked.max_parallel_angle_rad, "(0, 90)",
                "of opposite sides");
      v.Degrees("max_square_error_deg", c.unlinked.max_square_error_rad, "(0, 90)",
                "of a corner from a right angle");
    });
    v.Section("select", "good planes and bad", [&] { VisitSelect(c.select, v); });
  });
}

}  // namespace slam
