#pragma once

#include <Eigen/Core>

namespace eval {

/// Whether no direction has a negative variance. Numbers of different units must not decide, so it is
/// asked of the correlations; those of a file are off by its last digits.
/// @param C  symmetric
bool IsCovariance(const Eigen::MatrixXd& C);

}  // namespace eval
