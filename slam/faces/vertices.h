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
  double min_crossing_angle_rad = 0.5;
  double max_parallel_angle_rad = 0.17;
  double max_square_error_rad = 0.20;
  double max_feet_distance_m = 0.01;
  double max_plane_distance_m = 0.01;
  double box_margin_px = 12.0;
  double max_support_distance_px = 6.0;
  double max_extension = 0.25;
  double min_side_m = 0.02;
  double min_fill = 0.5;   // less: lines of something else, or a face mostly hidden
  double max_fill = 1.15;  // more: the rectangle misses part of the face
};

inline void VisitFields(VertexConfig& c, FieldVisitor& v) {
  v.Degrees("min_crossing_angle_deg", c.min_crossing_angle_rad, "(0, 90)",
            "smallest angle between two lines that make a corner");
  v.Degrees("max_parallel_angle_deg", c.max_parallel_angle_rad, "(0, 90)",
            "largest angle between opposite sides");
  v.Degrees("max_square_error_deg", c.max_square_error_rad, "(0, 90)",
            "largest deviation of a corner from a right angle");
  v.Number("max_feet_distance_m", c.max_feet_distance_m, "(0, inf)",
           "condition 1: largest distance between the feet of the common perpendicular");
  v.Number("max_plane_distance_m", c.max_plane_distance_m, "(0, inf)",
           "condition 2: largest distance of the feet from the plane");
  v.Number("box_margin_px", c.box_margin_px, "[0, inf)",
           "condition 3: largest distance of the projected feet outside the detection box");
  v.Number("max_support_distance_px", c.max_support_distance_px, "(0, inf)",
           "distance from every true edge point beyond which a corner is extrapolated");
  v.Number("max_extension", c.max_extension, "[0, inf)",
           "largest distance of a corner beyond the ends of its sides, as a part of their "
           "length, besides max_support_distance_px");
  v.Number("min_side_m", c.min_side_m, "(0, inf)", "shortest side of a rectangle");
  v.Number("min_fill", c.min_fill, "[0, inf)",
           "smallest visible area, as a part of the rectangle's; at most max_fill");
  v.Number("max_fill", c.max_fill, "(0, inf)",
           "largest visible area, as a part of the rectangle's");
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
