#include "slam/run/config_fields.h"

namespace slam {
namespace {

void VisitFeatures(PointFeatureConfig& c, FieldVisitor& v) {
  v.Integer("count", c.count, "[1, 10000]", "features an image, about");
  v.Integer("fast_threshold", c.fast_threshold, "[1, 254]", "grey levels");
  v.Integer("min_fast_threshold", c.min_fast_threshold, "[1, 254]",
            "where a cell has no corner");
  v.Integer("cell_px", c.cell_px, "[8, 1000]", "side of a cell");
  v.Number("bf_px_m", c.scale.bf_px_m, "(0, inf)", "b f of the virtual right camera");
  v.Integer("octaves", c.scale.octaves, "[1, 16]", "of the image pyramid");
  v.Number("octave_factor", c.scale.factor, "(1, 2]", "between neighbouring octaves");
  v.Number("close_baselines", c.scale.close_baselines, "(0, inf)",
           "depth trusted up to so many virtual baselines");
}

void VisitDepth(PointDepthConfig& c, FieldVisitor& v) {
  v.Integer("window_px", c.window_px, "[0, 5]", "half width of the square looked at");
  v.Number("max_step_ratio", c.max_step_ratio, "(0, 1)",
           "depths in it may differ by this share");
  v.Number("max_step_m", c.max_step_m, "(0, inf)", "or by this much, whichever is more");
  v.Number("min_depth_m", c.min_depth_m, "[0, inf)", "nearest depth used");
  v.Number("max_depth_m", c.max_depth_m, "(0, inf)", "farthest depth used");
}

void VisitMatch(const char* key, PointMatchConfig& c, FieldVisitor& v, const char* help) {
  v.Section(key, help, [&] {
    v.Integer("max_distance", c.max_distance, "[0, 256]", "differing bits");
    v.Number("max_ratio", c.max_ratio, "(0, 1]", "best over second best");
    v.Flag("check_orientation", c.check_orientation, "keep the main turns of the image alone");
  });
}

void VisitPose(PoseProblemConfig& c, FieldVisitor& v) {
  v.Integer("rounds", c.rounds, "[1, 10]", "optimise, then reclassify outliers");
  v.Integer("iterations", c.iterations, "[1, 100]", "Levenberg-Marquardt steps a round");
  v.Number("huber_planes", c.huber_planes, "(0, inf)",
           "Huber threshold of plane factors, sigmas");
  v.Flag("use_planes", c.use_planes, "f_pi: map plane seen as frame plane");
  v.Flag("use_boxes", c.use_boxes, "f_b_pi: projected corners against boxes");
  v.Flag("use_point_planes", c.use_point_planes, "f_p_pi: map points on planes");
  v.Flag("use_parallel", c.use_parallel, "f_pi_p: parallel planes");
  v.Flag("use_perpendicular", c.use_perpendicular, "f_pi_v: perpendicular planes");
}

void VisitDecision(KeyframeDecisionConfig& c, FieldVisitor& v) {
  v.Number("min_reference_ratio", c.min_reference_ratio, "[0, 1]",
           "tracked over the reference's points");
  v.Number("first_reference_ratio", c.first_reference_ratio, "[0, 1]",
           "the same with one keyframe");
  v.Integer("min_frames_between", c.min_frames_between, "[1, 1000]",
            "frames from one to the next");
  v.Integer("min_close_tracked", c.min_close_tracked, "[0, 100000]",
            "fewer tracked close points ...");
  v.Integer("min_close_untracked", c.min_close_untracked, "[0, 100000]",
            "... and more untracked: insert");
  v.Number("max_view_rad", c.max_view_rad, "(0, 3.15)",
           "a point seen from more beside every keyframe looks new");
  v.Number("max_new_ratio", c.max_new_ratio, "[0, 1]",
           "tracked points that look new over all: more, and insert");
}

void VisitProjection(PointProjectionConfig& c, FieldVisitor& v) {
  v.Number("straight_view_cosine", c.straight_view_cosine, "[-1, 1]",
           "from here on the smaller radius");
  v.Number("straight_radius_px", c.straight_radius_px, "(0, inf)",
           "search radius, seen as before");
  v.Number("radius_px", c.radius_px, "(0, inf)", "search radius, from another side");
}

void VisitRelocalise(PlaceSearchConfig& c, FieldVisitor& v) {
  v.Integer("max_keyframes", c.max_keyframes, "[1, 100000]", "tried a frame");
  v.Integer("min_matches", c.min_matches, "[4, 100000]", "descriptor matches with a keyframe");
  v.Integer("ransac_iterations", c.ransac_iterations, "[1, 1000000]",
            "samples solved for a pose");
  v.Integer("ransac_samples", c.ransac_samples, "[1, 10000000]", "samples drawn");
  v.Number("shape_tolerance", c.shape_tolerance, "(0, inf)",
           "distances in a sample may differ from the map's by this part of the depth");
  v.Number("ransac_error_px", c.ransac_error_px, "(0, inf)", "of an inlier");
  v.Integer("min_ransac_inliers", c.min_ransac_inliers, "[4, 100000]", "of a pose");
  VisitMatch("match", c.match, v, "with a keyframe, by descriptors");
  v.Number("max_rival_ratio", c.max_rival_ratio, "(0, 1]",
           "of the best place's inliers; another place with more makes both doubtful");
  v.Number("same_pose_m", c.same_pose_m, "(0, inf)", "nearer poses are one place");
  v.Number("same_pose_rad", c.same_pose_rad, "(0, 3.15)", "nearer poses are one place");
  v.Number("min_common_words", c.likeness.min_common_words, "(0, 1]",
           "share of the most words that any keyframe has in common with the image");
  v.Number("min_support", c.likeness.min_support, "(0, 1]",
           "share of the best supported keyframe's likeness");
  v.Integer("neighbours", c.likeness.neighbours, "[0, 100000]",
            "covisible keyframes whose likeness supports one");
}

void VisitLookAlike(LookAlikeConfig& c, FieldVisitor& v) {
  v.Integer("max_keyframes", c.max_keyframes, "[1, 100000]", "around, whose points compare");
  v.Integer("max_distance", c.max_distance, "[0, 256]", "bits by which points look alike");
  v.Number("min_shift_m", c.min_shift_m, "(0, inf)", "nearer is the same place");
  v.Number("reach", c.reach, "(0, 1)", "of a likeness, as a part of the distance");
  v.Integer("min_alike", c.min_alike, "[1, 100000]", "features that find their likeness");
  v.Number("min_share", c.min_share, "(0, 1]", "of those that find any point");
}

void VisitTracking(PointTrackingConfig& c, FieldVisitor& v) {
  VisitMatch("match_last", c.match_last, v, "with the last frame, by projection");
  VisitMatch("match_local", c.match_local, v, "with the local map, by projection");
  VisitMatch("match_reference", c.match_reference, v, "with the reference, by descriptors");
  v.Integer("min_start_points", c.min_start_points, "[1, 100000]",
            "features with depth that start the map");
  v.Number("last_radius_px", c.last_radius_px, "(0, inf)", "search around the prediction");
  v.Integer("min_last_matches", c.min_last_matches, "[0, 100000]",
            "below, the radius is doubled");
  v.Integer("min_reference_matches", c.min_reference_matches, "[0, 100000]",
            "with the reference keyframe");
  v.Integer("min_first_inliers", c.min_first_inliers, "[0, 100000]",
            "after the first optimisation");
  v.Integer("min_inliers", c.min_inliers, "[0, 100000]", "after the second");
  v.Integer("min_relocalised_inliers", c.min_relocalised_inliers, "[0, 100000]",
            "of a pose without prediction");
  v.Integer("max_temporary_points", c.max_temporary_points, "[0, 100000]",
            "of the last frame, from depth alone");
  v.Integer("max_local_keyframes", c.max_local_keyframes, "[1, 100000]",
            "bound of the work a frame");
  v.Number("local_radius_factor", c.local_radius_factor, "(0, inf)",
           "on the projection's radius");
}

}  // namespace

void VisitPoints(Config& c, FieldVisitor& v) {
  v.Section("point_features", "ORB extraction", [&] { VisitFeatures(c.point_features, v); });
  v.Section("point_depth", "depth of a feature",
            [&] { VisitDepth(c.point_features.depth, v); });
  v.Section("pose", "pose optimisation, eq13", [&] { VisitPose(c.point_search.pose, v); });
  v.Section("keyframe_decision", "when a frame becomes one",
            [&] { VisitDecision(c.tracking.decision, v); });
  v.Section("point_projection", "search of map points",
            [&] { VisitProjection(c.point_search.projection, v); });
  v.Section("relocalise", "finding a lost camera",
            [&] { VisitRelocalise(c.point_search.place, v); });
  v.Section("look_alike", "when a lost camera could as well be elsewhere",
            [&] { VisitLookAlike(c.tracking.look_alike, v); });
  v.Section("point_tracking", "tracking by points", [&] { VisitTracking(c.tracking, v); });
}

}  // namespace slam
