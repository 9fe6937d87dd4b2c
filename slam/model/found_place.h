#pragma once

#include <Eigen/Core>

namespace slam {

/// What a frame tells of the frame before it, in the world's axes. Zero: nothing new.
struct FoundPlace {
  Eigen::Vector3d off_w = Eigen::Vector3d::Zero();  ///< so far off that one was
  /// Covariances of its place in the world, until then and since.
  Eigen::Matrix3d before_w = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d after_w = Eigen::Matrix3d::Zero();
};

}  // namespace slam
