#pragma once

#include <Eigen/Core>
#include <span>

#include "slam/associate/refusals.h"
#include "slam/base/field_visitor.h"
#include "slam/base/result.h"
#include "slam/geometry/plane.h"
#include "slam/geometry/pose.h"

namespace slam {

/// Gates of the parameter test. A pair passes a `max_` gate strictly below it and a `min_` gate
/// strictly above it, as the paper prints.
struct PlaneGateConfig {
  double max_normal_angle_rad = 0.1745;  // 10 degrees
  double max_patch_offset_m = 0.05;
  double max_edge_point_distance_m = 0.05;
  double min_edge_point_ratio = 0.5;  // most of them
};

inline void VisitFields(PlaneGateConfig& c, FieldVisitor& v) {
  v.Degrees("max_normal_angle_deg", c.max_normal_angle_rad, "(0, 180)",
            "largest angle between the two planes' oriented normals; beta_T of eq6");
  v.Number("max_patch_offset_m", c.max_patch_offset_m, "(0, inf)",
           "largest distance of the patch's centroid from the map plane; d_T of eq7");
  v.Number("max_edge_point_distance_m", c.max_edge_point_distance_m, "(0, inf)",
           "distance from the map plane below which an edge point is near it; d_T' of eq8");
  v.Number("min_edge_point_ratio", c.min_edge_point_ratio, "[0, 1)",
           "share of the edge points that must be near the map plane; R_T of eq8");
}

/// Tests whether a plane seen now and a plane of the map can be one surface.
///
///   accepted  <=>  eq6 and (eq7 or eq8), of a patch that has edge points
///
/// @param pi_c           measured plane, camera frame, facing the camera
/// @param centroid_c     centroid of the measured patch, camera frame, metres
/// @param edge_points_c  boundary points B_c of the patch, camera frame, metres
/// @param pi_w           map plane, world frame
/// @param T_cw           world to camera
/// @returns the absolute patch offset (eq7), metres, or the first gate that refused the pair
///
/// Source: PAS-SLAM eq6 (corrected: signed cosine, so that the back of a board is not its
/// front), eq7 (corrected: measured at the patch, so that the result does not depend on the
/// world origin), eq8 (corrected: absolute distance). Cost: O(edge_points_c.size()).
Result<double, PairRefusal> TestPlaneGates(const Plane& pi_c, const Eigen::Vector3d& centroid_c,
                                           std::span<const Eigen::Vector3d> edge_points_c,
                                           const Plane& pi_w, const Pose& T_cw,
                                           const PlaneGateConfig& config);

}  // namespace slam
