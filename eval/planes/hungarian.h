#pragma once

#include <Eigen/Core>
#include <vector>

namespace eval {

/// One-to-one assignment of rows to columns with the greatest total weight; min(rows, columns)
/// pairs. O(n^3). Equal totals are resolved by the order of rows and columns alone.
/// @param weight  rows x columns, finite
/// @returns for each row its column, or -1
std::vector<int> AssignMaxWeight(const Eigen::MatrixXd& weight);

}  // namespace eval
