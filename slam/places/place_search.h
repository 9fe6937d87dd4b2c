#pragma once

#include <optional>

#include "slam/base/field_visitor.h"
#include "slam/features/match_features.h"
#include "slam/features/point_projection.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map.h"
#include "slam/places/keyframe_index.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// How the pose of a frame is found from places of the map alone.
struct PlaceSearchConfig {
  LikenessConfig likeness;
  int max_keyframes = 6;  ///< tried a frame, those that look most alike first; domain [1, inf)
  int min_matches = 15;   ///< descriptor matches with a keyframe; domain [4, inf)
  int ransac_iterations = 300;  ///< samples that are solved; domain [1, inf)
  int ransac_samples = 5000;    ///< samples that are drawn; domain [1, inf)
  // By how much distances in the frame and in the map may differ in a sample that is solved:
  // this part of the depth.
  double shape_tolerance = 0.05;  ///< domain (0, inf)
  double ransac_error_px = 4.0;
  int min_ransac_inliers = 10;
  PointMatchConfig match{70, 0.9, true};
  // Two places that both fit are none: the second best must have fewer inliers than this share
  // of the best one's, unless it says the same pose.
  double max_rival_ratio = 0.7;  ///< domain (0, 1]
  double same_pose_m = 0.1;      ///< domain (0, inf)
  double same_pose_rad = 0.1;    ///< domain (0, pi)
};

inline void VisitFields(PlaceSearchConfig& c, FieldVisitor& v) {
  v.Integer("max_keyframes", c.max_keyframes, "[1, 100000]", "tried a frame");
  v.Integer("min_matches", c.min_matches, "[4, 100000]", "descriptor matches with a keyframe");
  v.Integer("ransac_iterations", c.ransac_iterations, "[1, 1000000]",
            "samples solved for a pose");
  v.Integer("ransac_samples", c.ransac_samples, "[1, 10000000]", "samples drawn");
  v.Number("shape_tolerance", c.shape_tolerance, "(0, inf)",
           "distances in a sample may differ from the map's by this part of the depth");
  v.Number("ransac_error_px", c.ransac_error_px, "(0, inf)", "of an inlier");
  v.Integer("min_ransac_inliers", c.min_ransac_inliers, "[4, 100000]", "of a pose");
  v.Section("match", "with a keyframe, by descriptors", c.match);
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

/// How a camera is found by the points of a map: what tracking, relocalisation and loops share.
struct PointSearchConfig {
  PoseProblemConfig pose;
  PointProjectionConfig projection;
  PlaceSearchConfig place;
};

/// Whether two answers are one.
bool SamePose(const Pose& a_cw, const Pose& b_cw, const PlaceSearchConfig& config);

/// A pose found without any prediction, and the matches that it rests on.
struct PlacePose {
  int keyframe = kNone;
  Pose T_cw;
  std::vector<int> map_points;  ///< parallel to the frame's features; inliers alone
  int inliers = 0;
};

/// A pose from one keyframe's points alone, by descriptors, RANSAC and pose optimisation.
/// Deterministic: samples are keyed by frame and keyframe.
std::optional<PlacePose> FindPose(const Keyframe& keyframe, const Frame& frame, const Map& map,
                                  const Camera& camera, const FeatureScale& scale,
                                  const PointSearchConfig& config);

}  // namespace slam
