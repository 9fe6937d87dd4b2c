#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace sim {

/// Twice the area vector of a polygon (Newell): along its normal when it turns left.
Eigen::Vector3d TwiceArea(const std::vector<Eigen::Vector3d>& polygon);

/// Joins directed edges (pairs of vertex indices) into closed loops. Where loops meet in a
/// vertex, each keeps as far left as it can, seen from the front of `normal`.
std::vector<std::vector<Eigen::Vector3d>> Loops(const std::vector<std::pair<int, int>>& edges,
                                                const std::vector<Eigen::Vector3d>& vertices,
                                                const Eigen::Vector3d& normal);

/// Triangles (places in the polygon) that make up a simple polygon, flat or nearly; n - 2 of
/// them. Of the corners that can be cut off, the one that leaves the best shaped triangle goes
/// first.
std::vector<std::array<std::size_t, 3>> Triangulated(
    const std::vector<Eigen::Vector3d>& polygon);

/// The loop without corners that lie within `tolerance` of what is left (Douglas and Peucker,
/// from the two corners farthest apart).
std::vector<Eigen::Vector3d> Simplified(const std::vector<Eigen::Vector3d>& loop,
                                        double tolerance);

}  // namespace sim
