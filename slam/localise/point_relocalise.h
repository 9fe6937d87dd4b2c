#pragma once

#include <optional>

#include "slam/associate/point_point.h"
#include "slam/base/camera.h"
#include "slam/model/map.h"
#include "slam/model/scale_pyramid.h"
#include "slam/optimise/pose_problem.h"

namespace slam {

/// How a frame finds itself again in the map.
struct RelocaliseConfig {
  int max_keyframes = 12;  ///< tried a frame: the newest half, others in turn; domain [1, inf)
  int min_matches = 15;    ///< descriptor matches with a keyframe; domain [4, inf)
  int ransac_iterations = 300;  ///< domain [1, inf)
  double ransac_error_px = 4.0;
  int min_ransac_inliers = 10;
  PointMatchConfig match{50, 0.75, true};
};

/// A pose found without any prediction, and the matches that it rests on.
struct Relocalisation {
  int keyframe = kNone;
  Pose T_cw;
  std::vector<int> map_points;  ///< parallel to the frame's features; inliers alone
  int inliers = 0;
};

/// Matches the frame's descriptors with those of keyframes, and asks RANSAC over P3P and the
/// pose optimisation for a pose; the keyframe with the most inliers wins. Nothing is found
/// rather than a pose with fewer than `min_ransac_inliers`; the caller confirms it with the
/// local map. Deterministic: samples are keyed by frame and keyframe.
std::optional<Relocalisation> Relocalise(const Frame& frame, const Map& map,
                                         const Camera& camera, const ScalePyramid& scales,
                                         const PoseProblemConfig& pose,
                                         const RelocaliseConfig& config);

}  // namespace slam
