#pragma once

#include "slam/base/field_visitor.h"

namespace slam {

/// How map planes are made, updated, kept small and fused.
struct PlaneMapConfig {
  // A frame plane starts a candidate only if it is trusted this far.
  int min_pixels = 400;           ///< of the segment
  double min_inlier_ratio = 0.5;  ///< after the re-fit
  double max_distance_m = 4.0;    ///< of its centroid
  double max_offset_sigma_m = 0.02;
  double max_angle_sigma_rad = 0.09;

  // A candidate becomes a landmark once it has been seen ...
  int trial_frames = 3;      ///< in so many frames; 1: at once
  double trial_size = 12.0;  ///< and this large in all of them together, times min_pixels
  int max_trial_misses = 2;  ///< more, and more than half of its observations: it is dropped

  double keep_information = 0.97;   ///< of old observations when one is added; (0, 1]
  double voxel_m = 0.02;            ///< of clouds; grows when a plane is large
  int max_cloud_points = 2000;      ///< of one plane; its voxel doubles when reached
  int max_edge_points = 1000;       ///< of one plane
  double max_vertex_jump_m = 0.05;  ///< a corner observed farther off is another one
  /// Of each of four corners; a seen one weighs (3 mm)^2 / ((3 mm)^2 + its variance), at
  /// most 1.
  double min_face_weight = 5.0;
  double min_corner_weight = 1.0;  ///< of a corner that the final map tells of
  double face_margin_m = 0.02;     ///< beyond the sides of a known face nothing belongs to it
  double max_point_distance_m = 0.01;  ///< a map point nearer to the plane lies on it

  double min_fused_overlap = 0.2;  ///< share of the smaller cloud that two duplicates share
  int min_fused_observations =
      5;  ///< of both: before that, a step of millimetres is not settled
};

inline void VisitFields(PlaneMapConfig& c, FieldVisitor& v) {
  v.Integer("min_pixels", c.min_pixels, "[1, 10000000]",
            "of a segment that starts a candidate");
  v.Number("min_inlier_ratio", c.min_inlier_ratio, "[0, 1]", "of the same, after the re-fit");
  v.Number("max_distance_m", c.max_distance_m, "(0, inf)", "of the same");
  v.Number("max_offset_sigma_m", c.max_offset_sigma_m, "(0, inf)", "of the same");
  v.Degrees("max_angle_sigma_deg", c.max_angle_sigma_rad, "(0, 90)", "of the same");
  v.Integer("trial_frames", c.trial_frames, "[1, 1000]",
            "that show a candidate before it is a landmark");
  v.Number("trial_size", c.trial_size, "[0, inf)",
           "of a candidate in all these together, times min_pixels");
  v.Integer("max_trial_misses", c.max_trial_misses, "[0, 1000]",
            "a candidate is dropped beyond, and beyond half of its observations");
  v.Number("keep_information", c.keep_information, "(0, 1]",
           "of old observations when one is added");
  v.Number("voxel_m", c.voxel_m, "(0, inf)", "of clouds");
  v.Integer("max_cloud_points", c.max_cloud_points, "[1, 10000000]", "of one plane");
  v.Integer("max_edge_points", c.max_edge_points, "[1, 10000000]", "of one plane");
  v.Number("max_vertex_jump_m", c.max_vertex_jump_m, "(0, inf)",
           "a corner farther off is another one");
  v.Number(
      "min_face_weight", c.min_face_weight, "[0.25, 40]",
      "of each of four corners, for them to bound the surface; a seen corner weighs at most 1, "
      "half of it at a standard deviation of 3 mm");
  v.Number("min_corner_weight", c.min_corner_weight, "[0, 40]",
           "of a corner that the final map tells of");
  v.Number("face_margin_m", c.face_margin_m, "(0, inf)",
           "beyond the sides of such a face nothing belongs to it");
  v.Number("max_point_distance_m", c.max_point_distance_m, "(0, inf)",
           "of a map point on the plane");
  v.Number("min_fused_overlap", c.min_fused_overlap, "[0, 1]",
           "of the clouds of two duplicates");
  v.Integer("min_fused_observations", c.min_fused_observations, "[1, 100000]", "of both");
}

}  // namespace slam
