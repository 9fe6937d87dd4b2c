#include "slam/pose/point_constraints.h"

#include "slam/base/require.h"
#include "slam/model/map_queries.h"

namespace slam {

PointConstraint ConstraintOf(const PointFeature& feature, const Eigen::Vector3d& p_w,
                             const FeatureScale& scale) {
  return {p_w, feature.u_px, scale.Scale(feature.octave), feature.depth_m,
          feature.depth_sigma_m};
}

FramePoints PointConstraints(const Frame& frame, const Map& map, const FeatureScale& scale) {
  FramePoints points;
  for (std::size_t f = 0; f < frame.map_points.size(); ++f) {
    const int id = CurrentPoint(map, frame.map_points[f]);
    if (id == kNone) continue;
    const Eigen::Vector3d& p_w = map.points[static_cast<std::size_t>(id)].p_w;
    points.constraints.push_back(ConstraintOf(frame.features[f], p_w, scale));
    points.features.push_back(static_cast<int>(f));
  }
  return points;
}

void DropOutliers(Frame& frame, const FramePoints& points,
                  const std::vector<bool>& point_inliers) {
  Require(points.features.size() == point_inliers.size(),
          "DropOutliers: point_inliers is not parallel to the points");
  for (std::size_t i = 0; i < point_inliers.size(); ++i) {
    if (point_inliers[i]) continue;
    frame.map_points[static_cast<std::size_t>(points.features[i])] = kNone;
  }
}

int OptimiseByPoints(Frame& frame, const Map& map, const Camera& camera,
                     const FeatureScale& scale, const PoseProblemConfig& config) {
  const FramePoints points = PointConstraints(frame, map, scale);
  PoseProblem problem;
  problem.T_cw = frame.T_cw;
  problem.points = points.constraints;
  problem.prior = frame.prediction;
  const PoseSummary summary = OptimisePose(problem, camera, config);
  if (!summary.usable) return 0;
  frame.T_cw = summary.T_cw;
  frame.evidence = summary.evidence;
  frame.pose_covariance = summary.covariance;
  DropOutliers(frame, points, summary.point_inliers);
  return summary.inlier_count;
}

std::optional<Pose> PoseByPixels(const Frame& frame, const Map& map, const Camera& camera,
                                 const FeatureScale& scale) {
  PoseProblem problem;
  problem.T_cw = frame.T_cw;
  problem.points = PointConstraints(frame, map, scale).constraints;
  for (PointConstraint& point : problem.points) point.depth_m = 0.0;
  PoseProblemConfig few;  // steps: a pose by all that was measured is near
  few.rounds = 1;
  few.iterations = 3;
  const PoseSummary summary = OptimisePose(problem, camera, few);
  if (!summary.usable) return std::nullopt;
  return summary.T_cw;
}

}  // namespace slam
