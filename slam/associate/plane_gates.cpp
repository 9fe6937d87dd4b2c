#include "slam/associate/plane_gates.h"

#include <algorithm>
#include <cmath>

namespace slam {

Result<double, PairRefusal> TestPlaneGates(const Plane& pi_c, const Eigen::Vector3d& centroid_c,
                                           std::span<const Eigen::Vector3d> edge_points_c,
                                           const Plane& pi_w, const Pose& T_cw,
                                           const PlaneGateConfig& config) {
  const Plane map_pi_c = Transform(T_cw, pi_w);  // the map plane, where we now stand

  if (!(Angle(pi_c.n, map_pi_c.n) < config.max_normal_angle_rad))  // eq6
    return PairRefusal::kNormalAngle;
  if (edge_points_c.empty()) return PairRefusal::kNoEdgePoints;

  const double offset = std::abs(SignedDistance(map_pi_c, centroid_c));  // eq7
  const auto near = [&](const Eigen::Vector3d& B_c) {                    // eq8
    return std::abs(SignedDistance(map_pi_c, B_c)) < config.max_edge_point_distance_m;
  };
  const double ratio =
      static_cast<double>(std::count_if(edge_points_c.begin(), edge_points_c.end(), near)) /
      static_cast<double>(edge_points_c.size());

  const bool accepted =
      offset < config.max_patch_offset_m || ratio > config.min_edge_point_ratio;
  if (!accepted) return PairRefusal::kOffsetAndEdgePoints;
  return offset;
}

}  // namespace slam
