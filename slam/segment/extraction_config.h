#pragma once

#include "slam/base/field_visitor.h"
#include "slam/geometry/sensor_model.h"
#include "slam/segment/cluster_config.h"
#include "slam/segment/edge_config.h"
#include "slam/segment/growth_config.h"

namespace slam {

/// What it takes to split a segment inside the box of a detected regular object (box_split.h).
struct BoxSplitConfig {
  bool enabled = false;           ///< where noise leaves nothing to gain
  double min_score = 0.3;         ///< score of the detection; domain [0, 1)
  double margin_px = 4.0;         ///< a box is that much inexact, domain [0, inf), and ...
  double margin_fraction = 0.05;  ///< ... by this part of its size; domain [0, 1]
  /// Pixels vote in windows that hold this many independent errors; domain [1, 50].
  double vote_errors = 3.0;
  /// The step, in standard deviations of a vote: less, and noise makes regions of its own.
  /// Domain (0, inf).
  double min_step_votes = 2.5;
  /// The mean height of the region in its standard errors; domain (0, inf).
  double min_evidence_sigmas = 8.0;
  /// The region, with the segments that the box has already, must fill it: intersection over
  /// union of their bounds and the box. Domain [0, 1).
  double min_box_iou = 0.5;
  /// What is around the box is not as high, but for this part of it; domain [0, 1].
  double max_high_around = 0.1;
};

inline void VisitFields(BoxSplitConfig& c, FieldVisitor& v) {
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

/// Settings of plane extraction. A length here is of the sensor or of the image, and every
/// threshold on a surface is in units of the noise.
struct PlaneExtractionConfig {
  int block_px = 8;       ///< first clustering; domain [4, 64]
  int fine_block_px = 4;  ///< second clustering, of what the first left; domain [2, block_px]
  ClusterConfig coarse;
  ClusterConfig fine{.min_measured = 0.75, .max_block_error = 3.0, .min_blocks = 10};

  GrowthConfig growth;
  /// A block whose mean residual exceeds this many standard errors, over the model error, does
  /// not lie on its plane and is offered to the second clustering; domain (0, inf).
  double max_block_bias_sigmas = 3.0;
  /// Two touching segments are one plane if along their common boundary the planes are closer
  /// than this (root mean square, in sigmas, after their uncertainty), and over the pixels of
  /// the smaller. Domain (0, inf).
  double max_merge_gap_sigmas = 1.5;
  /// The same for parts that something in front separates, over the pixels of the smaller.
  double max_hidden_gap_sigmas = 1.5;
  /// How far a real sensor may bend a flat surface: gap over the smaller patch, and angle
  /// between two touching parts; and the step, measured across their boundary in sigmas of a
  /// pixel, that parts of one surface may seem to have. Domain (0, inf).
  double max_bend_sigmas = 3.0;
  double max_bend_rad = 0.12;
  double max_bend_step_sigmas = 1.5;
  /// Warp of the sensor, as measured in each frame (sensor_warp.h), that is allowed for; 0:
  /// none. Every sigma of it adds so many to the model error of the clusters, and to the gaps
  /// between parts that are bent or hidden. Domain [0, inf).
  double max_warp_sigmas = 1.0;
  double warp_model_error = 1.5;
  double warp_gap = 12.0;
  /// A part cut off from a segment stays with it if fewer than this part of the pixels around
  /// it lie behind the plane: what cuts it is in front. Domain [0, 1].
  double max_island_behind = 0.35;
  /// What lies nearer to the plane is neither behind it nor in front; domain [0, inf).
  double unsure_side_sigmas = 0.0;

  /// A segment needs this many pixels and this precision: fewer or worse is noise. At 1 m, 300
  /// pixels are 33 x 33 mm seen frontally.
  int min_pixels = 300;              ///< domain [3, inf)
  double max_angle_sigma_rad = 0.1;  ///< domain (0, inf)
  int min_island_pixels = 40;        ///< a smaller cut-off part is dropped; domain [1, inf)

  BoxSplitConfig box_split;  ///< once the frame's detections are known

  int point_grid_px = 6;  ///< spacing of FramePlane::points_c; domain [1, 64]
  EdgeConfig edges;       ///< for FramePlane::edge_points
};

inline void VisitFields(PlaneExtractionConfig& c, FieldVisitor& v) {
  v.Integer("block_px", c.block_px, "[4, 64]", "first clustering");
  v.Integer("fine_block_px", c.fine_block_px, "[2, 64]", "second clustering, at most block_px");
  v.Section("coarse", "first clustering", c.coarse);
  v.Section("fine", "second clustering", c.fine);
  v.Section("growth", "from blocks to pixels", c.growth);
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
  v.Section("box_split", "thin things in detection boxes", c.box_split);
  v.Integer("point_grid_px", c.point_grid_px, "[1, 64]", "spacing of a plane's points");
}

/// The defaults for a sensor, where they follow from more than its noise.
PlaneExtractionConfig ExtractionFor(DepthSensor sensor);

}  // namespace slam
