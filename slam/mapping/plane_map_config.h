#pragma once

#include "slam/base/field_visitor.h"
#include "slam/model/map_plane.h"

namespace slam {

/// How map planes are made, updated, kept small and fused.
struct PlaneMapConfig {
  double max_distance_m = 4.0;

  int trial_frames = 3;
  int trial_pixels = 4800;
  int max_trial_misses = 2;

  /// Errors of neighbouring frames are alike: a thousand frames do not know a thousand times as
  /// much as one, but as much as 1 / (1 - keep_information) of them.
  double keep_information = 0.97;
  double voxel_m = 0.02;
  int max_cloud_points = 2000;
  double max_vertex_jump_m = kMaxVertexJump_m;
  double min_face_weight = 5.0;
  double min_corner_weight = 1.0;
  double face_margin_m = 0.02;
  double max_point_distance_m = 0.01;

  double min_fused_overlap = 0.2;
  int min_fused_observations = 5;  // before that, a step of millimetres is not settled
};

inline void VisitFields(PlaneMapConfig& c, FieldVisitor& v) {
  v.Number(
      "max_distance_m", c.max_distance_m, "(0, inf)",
      "largest distance from the camera of the centroid of a segment that starts a candidate, "
      "or speaks for one");
  v.Integer("trial_frames", c.trial_frames, "[1, 1000]",
            "number of frames that must show a candidate before it is a landmark; 1: at once");
  v.Integer("trial_pixels", c.trial_pixels, "[0, 100000000]",
            "size of a candidate in all these frames together");
  v.Integer("max_trial_misses", c.max_trial_misses, "[0, 1000]",
            "frames without a candidate, beyond which, and beyond half of its observations, it "
            "is dropped");
  v.Number("keep_information", c.keep_information, "(0, 1]",
           "share of the information of old observations that is kept when one is added");
  v.Number("voxel_m", c.voxel_m, "(0, inf)",
           "side of the voxels of clouds; it grows when a plane is large");
  v.Integer("max_cloud_points", c.max_cloud_points, "[1, 10000000]",
            "largest number of cloud points of one plane; where it is reached voxels double");
  v.Number("max_vertex_jump_m", c.max_vertex_jump_m, "(0, inf)",
           "distance from a known corner beyond which an observed corner is another one");
  v.Number("min_face_weight", c.min_face_weight, "[0.25, 40]",
           "evidence for each of four corners from which they bound the surface; a seen corner "
           "weighs at most 1, half of it at a standard deviation of 3 mm");
  v.Number("min_corner_weight", c.min_corner_weight, "[0, 40]",
           "smallest evidence for a corner that is written to the final map");
  v.Number("face_margin_m", c.face_margin_m, "(0, inf)",
           "distance beyond the sides of a bounded face from which nothing belongs to it");
  v.Number("max_point_distance_m", c.max_point_distance_m, "(0, inf)",
           "largest distance from the plane of a map point that lies on it");
  v.Number("min_fused_overlap", c.min_fused_overlap, "[0, 1]",
           "share of the smaller cloud that two duplicates must share to be fused");
  v.Integer("min_fused_observations", c.min_fused_observations, "[1, 100000]",
            "smallest number of observations of each of two landmarks that are fused");
}

}  // namespace slam
