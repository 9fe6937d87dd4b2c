#include "slam/config/config_fields.h"

namespace slam {
namespace {

void VisitClasses(ClassTable& c, FieldVisitor& v) {
  v.Texts("regular", c.regular, "box-shaped: their faces are rectangles");
  v.Texts("unstructured", c.unstructured, "planes found on them are noise");
  v.Texts("other", c.other, "neither; a class in no list is this as well");
}

void VisitBoxTracks(BoxTracksConfig& c, FieldVisitor& v) {
  v.Flag("enabled", c.enabled, "off: detections pass through untouched");
  v.Number("max_duplicate_iou", c.max_duplicate_iou, "(0, 1]",
           "two boxes of a class above it are one");
  v.Number("min_match_iou", c.min_match_iou, "[0, 1)", "box and predicted box");
  v.Number("class_change_iou_penalty", c.class_change_iou_penalty, "[0, 1]",
           "less IoU for two classes");
  v.Integer("min_hits", c.min_hits, "[1, 100]", "detections that confirm a track");
  v.Integer("max_gap_frames", c.max_gap_frames, "[0, 100]", "misses in a row that are filled");
  v.Integer("max_coast_frames", c.max_coast_frames, "[1, 1000]",
            "misses in a row that end a track");
  v.Number("min_existence", c.min_existence, "[0, 1]",
           "fill while the object is this likely there");
  v.Number("survival", c.survival, "(0, 1]", "probability to stay in view, a frame");
  v.Number("max_detection_rate", c.max_detection_rate, "(0, 1)", "never trust a detector more");
  v.Number("min_visible_fraction", c.min_visible_fraction, "[0, 1]",
           "of a predicted box in the image");
  v.Number("jitter_px", c.jitter_px, "(0, inf)", "standard deviation of a box side");
  v.Number("jitter_fraction", c.jitter_fraction, "[0, 1]",
           "the same, as part of the box's size");
  v.Number("acceleration_px_s2", c.acceleration_px_s2, "(0, inf)",
           "standard deviation of a side's");
  v.Number("min_class_ratio", c.min_class_ratio, "[1, inf)",
           "evidence that outvotes another class");
  v.Number("class_memory", c.class_memory, "(0, 1]", "evidence kept from frame to frame");
}

void VisitClusters(ClusterConfig& c, FieldVisitor& v) {
  v.Number("min_measured", c.min_measured, "(0, 1]", "part of a block with depth");
  v.Number("max_block_error", c.max_block_error, "(0, inf)", "mean squared error, sigma^2");
  v.Number("max_jump_sigmas", c.max_jump_sigmas, "(0, inf)", "between neighbouring pixels");
  v.Number("max_merge_chi2", c.max_merge_chi2, "(0, inf)",
           "error that a merge adds, 3 degrees of freedom");
  v.Number("model_error_sigmas", c.model_error_sigmas, "[0, inf)",
           "of one real surface, besides noise");
  v.Integer("min_blocks", c.min_blocks, "[1, 100000]", "of a region");
}

void VisitExtraction(PlaneExtractionConfig& c, FieldVisitor& v) {
  v.Number("max_depth_m", c.max_depth_m, "(0, inf)", "beyond it a pixel is not measured");
  v.Integer("block_px", c.block_px, "[4, 64]", "first clustering");
  v.Integer("fine_block_px", c.fine_block_px, "[2, 64]", "second clustering, at most block_px");
  v.Section("coarse", "first clustering", [&] { VisitClusters(c.coarse, v); });
  v.Section("fine", "second clustering", [&] { VisitClusters(c.fine, v); });
  v.Number("max_block_bias_sigmas", c.max_block_bias_sigmas, "(0, inf)",
           "mean residual of a block");
  v.Number("max_merge_gap_sigmas", c.max_merge_gap_sigmas, "(0, inf)",
           "between touching segments of one plane");
  v.Number("max_island_behind", c.max_island_behind, "[0, 1]",
           "pixels behind, round a cut-off part");
  v.Integer("min_pixels", c.min_pixels, "[3, 1000000]", "of a segment");
  v.Degrees("max_angle_sigma_deg", c.max_angle_sigma_rad, "(0, 90)", "of a segment's normal");
  v.Integer("min_island_pixels", c.min_island_pixels, "[1, 1000000]", "of a cut-off part");
  v.Integer("point_grid_px", c.point_grid_px, "[1, 64]", "spacing of a plane's points");
  v.Integer("edge_step_px", c.edge_step_px, "[1, 64]", "spacing of edge points");
}

void VisitEdges(EdgeConfig& c, FieldVisitor& v) {
  v.Integer("step_px", c.step_px, "[1, 64]", "spacing along the contour");
  v.Integer("reach_px", c.reach_px, "[2, 16]", "how far beyond the boundary is looked");
  v.Number("min_step_sigmas", c.min_step_sigmas, "(0, inf)", "a depth step is at least this");
  v.Number("max_crease_start", c.max_crease_start, "(0, 1)",
           "first residual over last beyond a crease");
}

void VisitGates(PlaneGateConfig& c, FieldVisitor& v) {
  v.Degrees("max_normal_angle_deg", c.max_normal_angle_rad, "(0, 180)", "beta_T, eq6");
  v.Number("max_patch_offset_m", c.max_patch_offset_m, "(0, inf)", "d_T, eq7");
  v.Number("max_edge_point_distance_m", c.max_edge_point_distance_m, "(0, inf)", "d_T', eq8");
  v.Number("min_edge_point_ratio", c.min_edge_point_ratio, "[0, 1)", "R_T, eq8");
}

}  // namespace

void VisitPlanes(Config& c, FieldVisitor& v) {
  v.Section("classes", "what objects of a class are good for",
            [&] { VisitClasses(c.classes, v); });
  v.Section("box_tracks", "missed-detection compensation",
            [&] { VisitBoxTracks(c.box_tracks, v); });
  v.Section("plane_extraction", "planes of a depth image",
            [&] { VisitExtraction(c.plane_extraction, v); });
  v.Section("plane_edges", "boundary points of planes", [&] { VisitEdges(c.plane_edges, v); });
  v.Section("plane_gates", "association by parameters", [&] { VisitGates(c.plane_gates, v); });
}

}  // namespace slam
