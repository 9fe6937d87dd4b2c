#include "slam/run/config_fields.h"

namespace slam {
namespace {

void VisitKeyframes(KeyframeConfig& c, FieldVisitor& v) {
  v.Integer("min_new_points", c.min_new_points, "[0, 100000]", "made even from farther depths");
  v.Integer("min_shared_points", c.min_shared_points, "[1, 100000]",
            "make two keyframes covisible");
  v.Number("max_redundancy", c.max_redundancy, "(0, 1]",
           "share of points that others see as well");
  v.Integer("redundant_views", c.redundant_views, "[1, 1000]",
            "other keyframes that must see a point");
}

void VisitCulling(PointCullingConfig& c, FieldVisitor& v) {
  v.Number("min_found_ratio", c.min_found_ratio, "[0, 1]", "found over expected");
  v.Integer("trial_keyframes", c.trial_keyframes, "[1, 100]", "during which a point is young");
  v.Integer("min_weight", c.min_weight, "[1, 1000]", "wanted after two keyframes");
}

void VisitTriangulation(TriangulationConfig& c, FieldVisitor& v) {
  v.Integer("max_distance", c.max_distance, "[0, 256]", "differing bits");
  v.Number("max_ratio", c.max_ratio, "(0, 1]", "best over second best");
  v.Degrees("min_parallax_deg", c.min_parallax_rad, "(0, 180)", "between the two rays");
  v.Integer("neighbours", c.neighbours, "[0, 1000]", "keyframes tried");
}

void VisitFusion(PointFusionConfig& c, FieldVisitor& v) {
  v.Number("radius_px", c.radius_px, "(0, inf)", "search around the projection, octave 0");
  v.Integer("max_distance", c.max_distance, "[0, 256]", "differing bits");
  v.Integer("neighbours", c.neighbours, "[0, 1000]", "keyframes tried");
}

void VisitBundle(LocalBundleConfig& c, FieldVisitor& v) {
  v.Number("depth_sigma_px", c.depth_sigma_px, "(0, inf)",
           "of the virtual disparity, octave 0");
  v.Integer("max_keyframes", c.max_keyframes, "[1, 1000]", "poses that move");
  v.Integer("max_fixed_keyframes", c.max_fixed_keyframes, "[1, 1000]",
            "poses that hold the window");
  v.Integer("first_iterations", c.first_iterations, "[0, 1000]",
            "robust, before outliers are left out");
  v.Integer("last_iterations", c.last_iterations, "[0, 1000]", "plain, after it");
}

void VisitPlaneMap(PlaneMapConfig& c, FieldVisitor& v) {
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

}  // namespace

void VisitMapping(Config& config, FieldVisitor& v) {
  LocalMappingConfig& c = config.mapping;
  v.Section("mapping", "where the map is made", [&] {
    v.Flag("async", config.async_mapping,
           "beside tracking, which never waits for an adjustment; runs differ then");
  });
  v.Section("keyframes", "keyframes of the map", [&] { VisitKeyframes(c.keyframes, v); });
  v.Section("point_culling", "removal of map points", [&] { VisitCulling(c.culling, v); });
  v.Section("triangulation", "new points", [&] { VisitTriangulation(c.triangulation, v); });
  v.Section("point_fusion", "one point seen as two", [&] { VisitFusion(c.fusion, v); });
  v.Section("local_bundle", "local bundle adjustment", [&] { VisitBundle(c.bundle, v); });
  v.Section("plane_map", "landmark planes", [&] { VisitPlaneMap(config.plane_map, v); });
}

}  // namespace slam
