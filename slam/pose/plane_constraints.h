#pragma once

#include "slam/base/field_visitor.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// What the plane factors of the pose optimisation are worth, and when they are added.
struct PlaneConstraintConfig {
  // Three quarters of a bend's power are fixed to the device (docs/sensors.md): frames and landmark
  // share them. What is left, the root of a quarter, is what they can be apart by.
  double bend_share = 0.5;
  double point_plane_sigma_m = 0.01;
  double points_per_plane = 10.0;  // all points of a plane share its error
  double box_sigma_px = 8.0;
  double max_box_gap_px = 8.0;
};

inline void VisitFields(PlaneConstraintConfig& c, FieldVisitor& v) {
  v.Number(
      "bend_share", c.bend_share, "[0, 1]",
      "share of what the sensor bends by which a plane may differ from its landmark in f_pi "
      "(eq16)");
  v.Number("point_plane_sigma_m", c.point_plane_sigma_m, "(0, inf)",
           "standard deviation of a point's distance from its plane in f_p_pi (eq18)");
  v.Number("points_per_plane", c.points_per_plane, "(0, inf)",
           "number of points that all points of a plane together weigh at most");
  v.Number("box_sigma_px", c.box_sigma_px, "(0, inf)",
           "standard deviation of a box side in f_b_pi (eq17)");
  v.Number("max_box_gap_px", c.max_box_gap_px, "[0, inf)",
           "gap between a box side and the plane's own pixels beyond which the side is not "
           "the plane's edge");
}

/// The constraint of one matched pair, with the uncertainty of both sides.
/// @param offset_sigma_m, angle_sigma_rad  standard deviations of the frame plane, bends included
PlaneConstraint MakePlaneConstraint(const FramePlane& frame_plane, const MapPlane& map_plane,
                                    const Pose& T_cw, double offset_sigma_m,
                                    double angle_sigma_rad);

/// Widens a constraint by what is not known of its map plane, and notes how far off the world that may be.
/// @param estimate  of the map plane; not empty
/// @param x_w       where the patch is
void AddUncertainty(const PlaneEstimate& estimate, const Eigen::Vector3d& x_w,
                    PlaneConstraint& constraint);

/// A corner as the frame plane's camera saw it, against one that is known to `known_variance_m2` in
/// each direction of the plane; p_w is the caller's.
VertexConstraint MakeVertexConstraint(const Vertex& seen, const Plane& pi_c,
                                      double known_variance_m2);

/// Adds to `problem` the constraints that frame.plane_matches and frame.point_planes give:
/// planes (eq15, eq16), corners (f_v), boxes (eq17) and points on planes (eq18), in the order of
/// the frame's planes. What is assumed of planes among each other is slam/structure's.
void AddPlaneConstraints(const Frame& frame, const Map& map, const Camera& camera,
                         const PlaneConstraintConfig& config, PoseProblem& problem);

/// The landmark that the frame plane was matched with. Null: with none, or it is not trusted.
const MapPlane* TrustedMatch(const Frame& frame, const Map& map, std::size_t plane);

}  // namespace slam
