#pragma once

#include <vector>

namespace slam {

/// Assigns rows to columns one to one so that the summed gain is largest (Hungarian method,
/// shortest augmenting paths). Pairs without a positive gain are left unassigned.
/// @param gain  rows x columns, finite; every row of the same length
/// @returns for each row its column, or -1
/// Cost: O(n^3) for n = max(rows, columns).
std::vector<int> AssignForLargestGain(const std::vector<std::vector<double>>& gain);

}  // namespace slam
