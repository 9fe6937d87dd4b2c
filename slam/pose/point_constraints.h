#pragma once

#include <optional>
#include <vector>

#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// The points of a frame as constraints of its pose.
struct FramePoints {
  std::vector<PointConstraint> constraints;
  std::vector<int> features;  ///< parallel: the feature that each belongs to
};

/// One constraint of a feature and a point at p_w. Source: PAS-SLAM eq14.
PointConstraint ConstraintOf(const PointFeature& feature, const Eigen::Vector3d& p_w,
                             const FeatureScale& scale);

/// Constraints of all matched features, in the order of the features.
FramePoints PointConstraints(const Frame& frame, const Map& map, const FeatureScale& scale);

/// Takes the match from the features that the optimisation found to be outliers.
/// @param point_inliers parallel to `points.features`
void DropOutliers(Frame& frame, const FramePoints& points,
                  const std::vector<bool>& point_inliers);

/// Optimises the frame's pose over its matched points and takes the match from the outliers.
/// @returns the inliers; 0, and nothing is changed, when the outcome is not usable
int OptimiseByPoints(Frame& frame, const Map& map, const Camera& camera,
                     const FeatureScale& scale, const PoseProblemConfig& config);

/// The pose by the pixels of the matched points alone, a few steps from frame.T_cw; none where they
/// leave a direction open.
std::optional<Pose> PoseByPixels(const Frame& frame, const Map& map, const Camera& camera,
                                 const FeatureScale& scale);

}  // namespace slam
