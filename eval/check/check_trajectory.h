#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "eval/check/fault.h"

namespace eval {

/// A line of a trajectory in TUM's format.
struct CheckedPose {
  double stamp_s = 0;
  Eigen::Isometry3d T_wc = Eigen::Isometry3d::Identity();  ///< camera to world
  int line = 0;
};

/// Checks a file of `t tx ty tz qx qy qz qw` lines: numbers, order of stamps, unit quaternions.
std::vector<CheckedPose> CheckTrajectory(FolderCheck& check, const std::string& file);

}  // namespace eval
