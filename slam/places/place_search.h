#pragma once

#include <algorithm>
#include <optional>
#include <vector>

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
  int max_keyframes = 6;        // bounds the work
  int min_matches = 15;         // ORB-SLAM2
  int ransac_iterations = 300;  // ORB-SLAM2
  int ransac_samples = 5000;    // costs little: SameShape refuses most before they are solved
  double shape_tolerance = 0.05;
  double ransac_error_px = 4.0;
  int min_ransac_inliers = 10;         // ORB-SLAM2
  PointMatchConfig match{70, 0.9};     // between TH_LOW and TH_HIGH of ORB-SLAM2
  double max_second_best_ratio = 0.7;  // balances a wrong place against none
  double same_pose_m = 0.1;
  double same_pose_rad = 0.1;
};

inline void VisitFields(PlaceSearchConfig& c, FieldVisitor& v) {
  v.Integer("max_keyframes", c.max_keyframes, "[1, 100000]",
            "keyframes tried for a frame, those that look most alike first");
  v.Integer("min_matches", c.min_matches, "[4, 100000]",
            "descriptor matches with a keyframe, at least");
  v.Integer("ransac_iterations", c.ransac_iterations, "[1, 1000000]",
            "RANSAC samples solved for a pose, at most");
  v.Integer("ransac_samples", c.ransac_samples, "[1, 10000000]",
            "RANSAC samples drawn, at most");
  v.Number("shape_tolerance", c.shape_tolerance, "(0, inf)",
           "distances in a sample may differ from the map's by this share of the depth");
  v.Number("ransac_error_px", c.ransac_error_px, "(0, inf)",
           "largest reprojection error of a RANSAC inlier, at octave 0");
  v.Integer("min_ransac_inliers", c.min_ransac_inliers, "[4, 100000]",
            "inliers of a pose, at least");
  v.Section("match", "matching with a keyframe, by descriptors", c.match);
  v.Number("max_second_best_ratio", c.max_second_best_ratio, "(0, 1]",
           "another place with this share of the best one's inliers makes both doubtful");
  v.Number("same_pose_m", c.same_pose_m, "(0, inf)",
           "two poses are the same place when nearer than this and turned less than ...");
  v.Number("same_pose_rad", c.same_pose_rad, "(0, 3.15)", "... this");
  v.Number("min_common_words", c.likeness.min_common_words, "(0, 1]",
           "words shared with the image, as a share of the most that any keyframe shares");
  v.Number("min_support", c.likeness.min_support, "(0, 1]",
           "likeness with neighbours, as a share of that of the best supported keyframe");
  v.Integer("neighbours", c.likeness.neighbours, "[0, 100000]",
            "covisible keyframes whose likeness supports a keyframe");
}

/// How a camera is found by the points of a map: what tracking, relocalisation and loops share.
struct PointSearchConfig {
  PoseProblemConfig pose;
  PointProjectionConfig projection;
  PlaceSearchConfig place;
};

/// Whether two poses are the same place.
bool SamePose(const Pose& a_cw, const Pose& b_cw, const PlaceSearchConfig& config);

/// The pose with most inliers, the first of several. Null: there is none, or another place fits nearly
/// as well.
/// @param found  poses of one frame, each with T_cw and inliers
template <typename Found>
const Found* ClearlyBest(const std::vector<Found>& found, const PlaceSearchConfig& config) {
  const auto best =
      std::max_element(found.begin(), found.end(),
                       [](const Found& a, const Found& b) { return a.inliers < b.inliers; });
  const auto rivals = [&](const Found& other) {
    return other.inliers >= config.max_second_best_ratio * best->inliers &&
           !SamePose(other.T_cw, best->T_cw, config);
  };
  return found.empty() || std::any_of(found.begin(), found.end(), rivals) ? nullptr : &*best;
}

/// A pose found without any prediction, and the matches that it rests on.
struct PlacePose {
  Pose T_cw;
  std::vector<int> map_points;  ///< parallel to the frame's features; inliers alone
  int inliers = 0;
};

/// A pose from one keyframe's points alone, by descriptors, RANSAC and pose optimisation.
/// Deterministic: samples are keyed by frame and keyframe.
std::optional<PlacePose> FindPose(const Keyframe& keyframe, const Frame& frame, const Map& map,
                                  const Camera& camera, const FeatureScale& scale,
                                  const PointSearchConfig& search);

}  // namespace slam
