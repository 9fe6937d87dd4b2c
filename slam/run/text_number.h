#pragma once

#include <string>

#include "slam/geometry/pose.h"

namespace slam {

/// The shortest text that reads back as the same number, -0 as 0.
/// @throws std::invalid_argument when it is not finite: such a number is never written.
std::string FiniteNumberText(double x);

/// A timestamp as TUM writes it, six decimals, when those read back as the same number; else
/// the shortest text that does, without exponent. Also the T of segmentation/T.png.
std::string StampText(double timestamp_s);

/// One line of a TUM trajectory, "t tx ty tz qx qy qz qw" with T_wc and qw >= 0, and a newline.
std::string TrajectoryLine(double timestamp_s, const Pose& T_cw);

/// One line of trajectory_covariance.txt, "t c11 c12 ... c16 c22 ... c66": the upper triangle, row
/// by row, and a newline.
/// @param covariance  symmetric
std::string CovarianceLine(double timestamp_s, const Matrix6d& covariance);

}  // namespace slam
