#pragma once

#include <Eigen/Core>

namespace slam {

/// Line x = P + s V in three dimensions. Source: PAS-SLAM, L = (P^T, V^T)^T.
struct Line {
  Eigen::Vector3d P = Eigen::Vector3d::Zero();   ///< a point on it, metres
  Eigen::Vector3d V = Eigen::Vector3d::UnitX();  ///< unit direction
};

}  // namespace slam
