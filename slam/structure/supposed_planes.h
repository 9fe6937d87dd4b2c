#pragma once

#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"
#include "slam/model/measured_plane.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// Structure "supposed": what supposed planes are worth, and when two are the same.
struct SupposedConfig {
  // What edges err by stays from frame to frame. SP-SLAM's weights, 1 degree and 10 mm, make desks in
  // the dark worse by a tenth (kinect1) to a half (d435); 30 mm, stacks by a seventh.
  double angle_sigma_rad = 0.052;  // 3 degrees
  double offset_sigma_m = 0.02;
  double max_angle_rad = 0.17;
  double max_offset_m = 0.03;
  int min_observations = 3;
  int max_misses = 30;
};

inline void VisitFields(SupposedConfig& c, FieldVisitor& v) {
  v.Degrees("angle_sigma_deg", c.angle_sigma_rad, "(0, 90)",
            "standard deviation of a supposed plane's normal");
  v.Number("offset_sigma_m", c.offset_sigma_m, "(0, inf)",
           "standard deviation of where a supposed plane's edge is seen");
  v.Degrees("max_angle_deg", c.max_angle_rad, "(0, 90)",
            "largest angle between a supposed plane and what it is matched with");
  v.Number("max_offset_m", c.max_offset_m, "(0, inf)",
           "largest distance of its edge from what it is matched with");
  v.Integer("min_observations", c.min_observations, "[1, 100000]",
            "number of frames that must have seen a supposed plane before it holds a pose");
  v.Integer("max_misses", c.max_misses, "[0, 100000]",
            "frames after which a supposed plane of fewer observations is dropped");
}

/// A plane at a right angle to the measured one through each of its edge lines: they are only found
/// where the surface itself ends, not where something hides it or the image ends. It faces away from
/// the patch; its centroid is on the edge, nearest to the patch's middle.
/// Source: SP-SLAM (Zhang, Wang, Qi, Liao, Wei 2019).
std::vector<MeasuredPlane> SupposePlanes(const FramePlane& plane, const SupposedConfig& config);

/// Adds to `problem` the supposed planes of the frame's trusted, matched planes that the map knows
/// as supposed planes of the same landmark. Plane factors, eq16. Not matched, as in SP-SLAM, are
/// landmarks that were measured at the edge: a face does not begin quite where the other ends, nor
/// at quite a right angle.
void AddSupposedPlanes(const Frame& frame, const Map& map, const SupposedConfig& config,
                       PoseProblem& problem);

/// Takes the frame's supposed planes into the map, at the frame's pose. Those of the frame that the
/// map begins with hold poses at once, others after config.min_observations.
/// @param keep  share of old information that is kept, as of AddObservation
void LearnSupposedPlanes(const Frame& frame, double keep, const SupposedConfig& config,
                         Map& map);

}  // namespace slam
