#pragma once

#include "slam/base/field_visitor.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"
#include "slam/pose/pose_prior.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// What the plane factors of the pose optimisation are worth, and when they are added.
struct PlaneConstraintConfig {
  double plane_offset_floor_m = 0.003;  ///< of f_pi; domain (0, inf)
  double plane_angle_floor_rad = 0.01;  ///< of f_pi; domain (0, inf)
  double point_plane_sigma_m = 0.01;    ///< of f_p_pi; domain (0, inf)
  double points_per_plane = 10.0;  ///< a plane's points weigh no more than so many together
  double box_sigma_px = 8.0;       ///< of f_b_pi; domain (0, inf)
  double max_box_gap_px =
      8.0;  ///< a box side farther from the plane's own pixels is not its edge
  double max_direction_angle_rad = 0.05;  ///< how far from parallel or a right angle; (0, 0.5)
  double max_direction_sigmas = 2.0;      ///< and by its own uncertainty
  double direction_sigma_rad = 0.03;      ///< of f_pi_p and f_pi_v: structure is a hypothesis
  double min_direction_area_m2 = 0.05;    ///< of both planes
  int min_direction_observations = 5;     ///< of the map plane
};

inline void VisitFields(PlaneConstraintConfig& c, FieldVisitor& v) {
  v.Number("plane_offset_floor_m", c.plane_offset_floor_m, "(0, inf)", "of f_pi");
  v.Degrees("plane_angle_floor_deg", c.plane_angle_floor_rad, "(0, 90)", "of f_pi");
  v.Number("point_plane_sigma_m", c.point_plane_sigma_m, "(0, inf)", "of f_p_pi");
  v.Number("points_per_plane", c.points_per_plane, "(0, inf)",
           "a plane's points weigh no more together");
  v.Number("box_sigma_px", c.box_sigma_px, "(0, inf)", "of f_b_pi");
  v.Number("max_box_gap_px", c.max_box_gap_px, "[0, inf)",
           "a farther box side is not the plane's edge");
  v.Degrees("max_direction_angle_deg", c.max_direction_angle_rad, "(0, 28)",
            "from parallel or a right angle");
  v.Number("max_direction_sigmas", c.max_direction_sigmas, "(0, inf)",
           "the same, by its own uncertainty");
  v.Degrees("direction_sigma_deg", c.direction_sigma_rad, "(0, 90)", "of f_pi_p and f_pi_v");
  v.Number("min_direction_area_m2", c.min_direction_area_m2, "[0, inf)", "of both planes");
  v.Integer("min_direction_observations", c.min_direction_observations, "[1, 100000]",
            "of the map plane");
}

/// The constraint of one matched pair, with the uncertainty of both sides.
PlaneConstraint MakePlaneConstraint(const FramePlane& frame_plane, const MapPlane& map_plane,
                                    const Pose& T_cw, double offset_floor_m,
                                    double angle_floor_rad);

/// Adds to `problem` the constraints that frame.plane_matches and frame.point_planes give:
/// planes (eq15, eq16), boxes (eq17), points on planes (eq18), and parallel and perpendicular
/// planes (eq19, eq20). The last two are added only between large planes whose measured angle
/// is close to the hypothesis and statistically consistent with it: nearly parallel is not
/// parallel. In the order of the frame's planes, then of the map's.
void AddPlaneConstraints(const Frame& frame, const Map& map, const Camera& camera,
                         const PosePrior& prior, const PlaneConstraintConfig& config,
                         PoseProblem& problem);

}  // namespace slam
