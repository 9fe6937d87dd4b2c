#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/folder.h"

namespace eval {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// What a system says its pose is worth: the covariance of xi, where T_wc Exp(xi) is the true
/// pose. xi = (step along x, y, z in metres; turn about x, y, z in radians), in the axes of the
/// camera, so that it is the same in any world.
struct PoseCovariance {
  double stamp_s = 0.0;
  Matrix6d of_xi = Matrix6d::Zero();  ///< symmetric, no direction has a negative variance
  int line = 0;                       ///< in its file; 0 when it comes from none
};

/// Reads trajectory_covariance.txt, lines of a stamp and the 21 numbers of the upper triangle, row
/// by row; by rising stamp. A pose that is known exactly, as that which defines the world, has
/// zeros. Lines of another form are passed over with a warning, for the format does not ask for the
/// file.
/// @returns nothing when all lines are so: another program's file of that name
std::optional<std::vector<PoseCovariance>> ReadPoseCovariances(
    Folder& folder, const std::string& file = "trajectory_covariance.txt");

}  // namespace eval
