#pragma once

#include <Eigen/Core>
#include <array>

#include "slam/base/index.h"

namespace slam {

/// Three directions at right angles that were seen from a keyframe, and turn with it when the map
/// is adjusted.
struct ManhattanFrame {
  int keyframe = 0;
  Eigen::Matrix3d axes_k = Eigen::Matrix3d::Identity();  ///< columns, its camera; orthonormal
  Eigen::Vector3d sigma_rad = Eigen::Vector3d::Zero();   ///< standard deviation of each
  /// Ids of the landmarks whose normals the columns are; kNone: that column was not seen. All
  /// kNone where the directions are those of the whole map.
  std::array<int, 3> landmarks{kNone, kNone, kNone};
  int seen = 0;  ///< keyframes that saw it
};

}  // namespace slam
