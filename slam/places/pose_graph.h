#pragma once

#include <vector>

#include "slam/geometry/pose.h"

namespace slam {

/// What is known of two poses: T_ij = T_iw T_wj.
struct PoseEdge {
  int i = 0, j = 0;  ///< positions in the vector of poses
  Pose T_ij;
};

/// Finds the poses that agree best with the edges:
///   minimise sum of |(rho / sigma_m, omega / sigma_rad)|^2,
///   (rho, omega) = Log(T_ij^-1 T_iw T_wj), sigma_m = 0.01, sigma_rad = 0.01.
/// The first pose stays. Poses that no edge ties to it stay as they are. Ceres, one thread,
/// bounded iterations: the same input gives the same bytes.
/// @param poses  T_iw, by position; changed
/// @returns whether it was solved; otherwise the poses are as before
/// @throws std::invalid_argument for an edge that names no pose.
bool OptimisePoseGraph(std::vector<Pose>& poses, const std::vector<PoseEdge>& edges);

}  // namespace slam
