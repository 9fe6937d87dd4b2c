#pragma once

#include <optional>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/faces/common_perpendicular.h"
#include "slam/faces/edge_lines.h"
#include "slam/geometry/box.h"
#include "slam/geometry/camera.h"
#include "slam/model/frame_plane.h"

namespace slam {

/// A `max_` bound is passed strictly below it.
struct VertexConfig {
  double min_crossing_angle_rad = 0.5;   ///< between lines that make a corner; (0, pi/2)
  double max_parallel_angle_rad = 0.17;  ///< between opposite sides; domain (0, pi/2)
  double max_square_error_rad = 0.20;    ///< a corner's, from a right angle; domain (0, pi/2)
  double max_feet_distance_m = 0.01;     ///< condition 1; domain (0, inf)
  double max_plane_distance_m = 0.01;    ///< condition 2; domain (0, inf)
  double box_margin_px = 12.0;           ///< condition 3: outside the box by less; [0, inf)
  /// A corner farther than this from every true edge point is extrapolated; domain (0, inf).
  double max_support_distance_px = 6.0;
  /// Where a partial outline has two sides only, its corner must be at most this part of their
  /// length beyond the end of either. Domain [0, inf).
  double max_extension = 0.25;
  double min_side_m = 0.02;  ///< a rectangle's shortest side; domain (0, inf)
  /// Visible area over the rectangle's: less means lines of something else, or a face mostly
  /// hidden; more means that the rectangle misses part of the face. Domain [0, max].
  double min_fill = 0.5;
  double max_fill = 1.15;  ///< domain [min, inf)
};

inline void VisitFields(VertexConfig& c, FieldVisitor& v) {
  v.Degrees("min_crossing_angle_deg", c.min_crossing_angle_rad, "(0, 90)",
            "of two lines at a corner");
  v.Degrees("max_parallel_angle_deg", c.max_parallel_angle_rad, "(0, 90)", "of opposite sides");
  v.Degrees("max_square_error_deg", c.max_square_error_rad, "(0, 90)",
            "of a corner from a right angle");
  v.Number("max_feet_distance_m", c.max_feet_distance_m, "(0, inf)", "condition 1, eq2");
  v.Number("max_plane_distance_m", c.max_plane_distance_m, "(0, inf)", "condition 2, eq3");
  v.Number("box_margin_px", c.box_margin_px, "[0, inf)",
           "condition 3, outside the box by less");
  v.Number("max_support_distance_px", c.max_support_distance_px, "(0, inf)",
           "farther is extrapolated");
  v.Number("max_extension", c.max_extension, "[0, inf)", "of a side beyond its end");
  v.Number("min_side_m", c.min_side_m, "(0, inf)", "of a rectangle");
  v.Number("min_fill", c.min_fill, "[0, inf)", "visible area over the rectangle's");
  v.Number("max_fill", c.max_fill, "(0, inf)", "the same, at most");
}

/// The corner of a face at which two of its edge lines meet: the middle of the feet of their
/// common perpendicular, projected onto the plane, under the paper's three conditions:
///   1. the feet are close to each other,
///   2. both are close to the plane,
///   3. both project into the detection box (recorded image), if there is one.
///
/// Source: PAS-SLAM, Extraction Vertices of Planes; eq2, eq3, eq5 in common_perpendicular.h.
std::optional<Eigen::Vector3d> MeetingPoint(const Line& L_i, const Line& L_j, const Plane& pi_c,
                                            const Camera& camera,
                                            const std::optional<Box>& box_px,
                                            const VertexConfig& config);

/// The corners of a rectangular face from its edge lines.
///
/// Two pairs of parallel lines at right angles that bound the visible region make four
/// vertices. Failing that, the face is seen in part: two parallel sides and one across give two
/// vertices, two sides one. Vertices are in order around the face, counter-clockwise seen from
/// its front, and each is marked if no edge point lies near it.
///
/// @param lines  FindEdgeLines of the plane
std::vector<Vertex> FindVertices(const FramePlane& plane, const std::vector<EdgeLine>& lines,
                                 const Camera& camera, const std::optional<Box>& box_px,
                                 const VertexConfig& config);

}  // namespace slam
