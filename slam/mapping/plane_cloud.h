#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/geometry/plane.h"

namespace slam {

/// Adds points to a cloud thinned to one point a voxel: the first that came stays. The voxels
/// are squares on the plane, so noise along the normal makes no second layer. When the cloud
/// exceeds `max_points` the voxel doubles until it fits: memory is bounded however large the
/// plane.
/// @returns side of the voxels that it was thinned by, metres: what the next merge begins with,
///          so that a cloud is as dense in one place as in another
/// @param pi_w           the plane, for the directions of the grid
/// @param grid_origin_w  a corner of the grid
/// Cost: O(n) of both clouds.
[[nodiscard]] double MergeIntoCloud(std::vector<Eigen::Vector3d>& cloud_w,
                                    const std::vector<Eigen::Vector3d>& points_w,
                                    const Plane& pi_w, const Eigen::Vector3d& grid_origin_w,
                                    double voxel_m, int max_points);

/// The middle of the cloud, on the plane. @pre the cloud is not empty
Eigen::Vector3d CloudCentroid(const std::vector<Eigen::Vector3d>& cloud_w, const Plane& pi_w);

/// Share of the smaller cloud's voxels that the other cloud has a point in, or at most `reach`
/// voxels beside, [0, 1].
double CloudOverlap(const std::vector<Eigen::Vector3d>& one_w,
                    const std::vector<Eigen::Vector3d>& other_w, const Plane& pi_w,
                    double voxel_m, int reach = 1);

/// Convex outline of points projected onto a plane, counter-clockwise seen from its front, and
/// its area. Fewer than three points that span an area: empty and 0.
struct Outline {
  std::vector<Eigen::Vector3d> hull_w;
  double area_m2 = 0.0;
};
Outline ConvexOutline(const std::vector<Eigen::Vector3d>& points_w, const Plane& pi_w);

}  // namespace slam
