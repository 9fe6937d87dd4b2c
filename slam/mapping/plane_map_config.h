#pragma once

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

}  // namespace slam
