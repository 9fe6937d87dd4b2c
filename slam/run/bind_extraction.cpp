#include "slam/run/config_fields.h"
#include "slam/segment/depth_sensor.h"

namespace slam {
namespace {

void VisitNoise(DepthNoise& c, FieldVisitor& v) {
  v.Number("floor_m", c.floor_m, "(0, inf)", "standard deviation at and below nearest_m");
  v.Number("linear_per_m", c.linear_per_m, "[0, inf)", "growth with depth");
  v.Number("quadratic_per_m", c.quadratic_per_m, "[0, inf)", "growth with depth");
  v.Number("nearest_m", c.nearest_m, "[0, inf)", "where growth begins");
  v.Number("grazing_m", c.grazing_m, "[0, inf)", "growth with incidence");
  v.Number("correlated_px", c.correlated_px, "[1, inf)", "pixels that share one error");
}

void VisitGrowth(GrowthConfig& c, FieldVisitor& v) {
  v.Integer("block_px", c.block_px, "[2, 64]", "regions spread from block to block");
  v.Number("max_pixel_sigmas", c.max_pixel_sigmas, "(0, inf)",
           "distance of a plane's pixel from it");
  v.Integer("vote_reach_px", c.vote_reach_px, "[0, 16]",
            "pixels that decide between two planes");
  v.Number("min_gain", c.min_gain, "[0, inf)", "over the next best plane, squared sigmas");
}

void VisitClusters(ClusterConfig& c, FieldVisitor& v) {
  v.Number("min_measured", c.min_measured, "(0, 1]", "part of a block with depth");
  v.Number("max_block_error", c.max_block_error, "(0, inf)", "mean squared error, sigma^2");
  v.Number("max_jump_sigmas", c.max_jump_sigmas, "(0, inf)", "between neighbouring pixels");
  VisitEnum(v, "merge_rule", c.merge_rule, {"added_error", "mean_error"},
            "mean_error is PEAC's");
  v.Number("max_merge_chi2", c.max_merge_chi2, "(0, inf)",
           "error that a merge adds, 3 degrees of freedom");
  v.Number("model_error_sigmas", c.model_error_sigmas, "[0, inf)",
           "of one real surface, besides noise");
  v.Integer("min_blocks", c.min_blocks, "[1, 100000]", "of a region");
}

void VisitBoxSplit(BoxSplitConfig& c, FieldVisitor& v) {
  v.Flag("enabled", c.enabled, "split segments inside detection boxes");
  v.Number("min_score", c.min_score, "[0, 1)", "of the detection");
  v.Number("margin_px", c.margin_px, "[0, inf)", "a box is that much inexact, and");
  v.Number("margin_fraction", c.margin_fraction, "[0, 1]", "by this part of its size");
  v.Number("vote_errors", c.vote_errors, "[1, 50]", "independent errors that vote on a pixel");
  v.Number("min_step_votes", c.min_step_votes, "(0, inf)",
           "step, in standard deviations of a vote");
  v.Number("min_evidence_sigmas", c.min_evidence_sigmas, "(0, inf)",
           "mean height, in its standard errors");
  v.Number("min_box_iou", c.min_box_iou, "[0, 1)", "of what is found and the box");
  v.Number("max_high_around", c.max_high_around, "[0, 1]", "part around the box as high");
}

void VisitPlaneExtraction(PlaneExtractionConfig& c, FieldVisitor& v) {
  const DepthSensor before = c.sensor;
  VisitEnum(v, "sensor", c.sensor, DepthSensorNames(),
            "whose values the other keys default to");
  if (c.sensor != before) c = ExtractionFor(c.sensor);
  v.Section("noise", "of a depth; (C) uses it as well", [&] { VisitNoise(c.noise, v); });
  v.Number("max_depth_m", c.max_depth_m, "(0, inf)", "beyond it a pixel is not measured");
  v.Integer("block_px", c.block_px, "[4, 64]", "first clustering");
  v.Integer("fine_block_px", c.fine_block_px, "[2, 64]", "second clustering, at most block_px");
  v.Section("coarse", "first clustering", [&] { VisitClusters(c.coarse, v); });
  v.Section("fine", "second clustering", [&] { VisitClusters(c.fine, v); });
  v.Section("growth", "from blocks to pixels", [&] { VisitGrowth(c.growth, v); });
  v.Number("max_block_bias_sigmas", c.max_block_bias_sigmas, "(0, inf)",
           "mean residual of a block");
  v.Number("max_merge_gap_sigmas", c.max_merge_gap_sigmas, "(0, inf)",
           "between touching segments of one plane");
  v.Number("max_hidden_gap_sigmas", c.max_hidden_gap_sigmas, "(0, inf)",
           "between parts that something hides");
  v.Number("max_bend_sigmas", c.max_bend_sigmas, "(0, inf)",
           "gap that a sensor's bend may make");
  v.Number("max_bend_step_sigmas", c.max_bend_step_sigmas, "(0, inf)",
           "step between parts that a sensor has bent");
  v.Degrees("max_bend_deg", c.max_bend_rad, "(0, 90)", "angle that a sensor's bend may make");
  v.Number("max_warp_sigmas", c.max_warp_sigmas, "[0, inf)",
           "of a frame, that is allowed for; 0: none");
  v.Number("warp_model_error", c.warp_model_error, "[0, inf)",
           "added to the model error by a sigma of warp");
  v.Number("warp_gap", c.warp_gap, "[0, inf)", "added to bent and hidden gaps by it");
  v.Number("max_island_behind", c.max_island_behind, "[0, 1]",
           "pixels behind, round a cut-off part");
  v.Number("unsure_side_sigmas", c.unsure_side_sigmas, "[0, inf)",
           "nearer is neither behind nor in front");
  v.Integer("min_pixels", c.min_pixels, "[3, 1000000]", "of a segment");
  v.Degrees("max_angle_sigma_deg", c.max_angle_sigma_rad, "(0, 90)", "of a segment's normal");
  v.Integer("min_island_pixels", c.min_island_pixels, "[1, 1000000]", "of a cut-off part");
  v.Section("box_split", "thin things in detection boxes",
            [&] { VisitBoxSplit(c.box_split, v); });
  v.Integer("point_grid_px", c.point_grid_px, "[1, 64]", "spacing of a plane's points");
}

void VisitEdges(EdgeConfig& c, FieldVisitor& v) {
  v.Integer("step_px", c.step_px, "[1, 64]", "spacing along the contour");
  v.Integer("reach_px", c.reach_px, "[2, 16]", "how far beyond the boundary is looked");
  v.Number("min_step_sigmas", c.min_step_sigmas, "(0, inf)", "a depth step is at least this");
  v.Number("max_crease_start", c.max_crease_start, "(0, 1)",
           "first residual over last beyond a crease");
  v.Number("min_rising_area", c.min_rising_area, "[0, inf)",
           "of what ends a surface at a concave crease, over the surface's");
}

}  // namespace

void VisitExtraction(Config& c, FieldVisitor& v) {
  v.Section("plane_extraction", "planes of a depth image",
            [&] { VisitPlaneExtraction(c.plane_extraction, v); });
  v.Section("plane_edges", "boundary points of planes",
            [&] { VisitEdges(c.plane_extraction.edges, v); });
}

}  // namespace slam
