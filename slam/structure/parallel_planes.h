#pragma once

#include "slam/base/field_visitor.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// Structure "parallel": when a frame plane and a landmark count as parallel or perpendicular.
struct ParallelConfig {
  double max_angle_rad = 0.05;
  double max_sigmas = 2.0;  // passes 95 % of the pairs that are as supposed
  double pose_sigma_rad =
      0.004;                // 0.23 degrees: what a first Kinect bends turns the pose so far
  double sigma_rad = 0.03;  // structure is a hypothesis: weaker than f_pi
  double min_area_m2 = 0.05;
  int min_observations = 5;
};

inline void VisitFields(ParallelConfig& c, FieldVisitor& v) {
  v.Degrees("max_angle_deg", c.max_angle_rad, "(0, 28)",
            "largest angle by which two planes miss being parallel or at a right angle");
  v.Number("max_sigmas", c.max_sigmas, "(0, inf)",
           "the same bound, in standard deviations of the measured angle");
  v.Degrees("pose_sigma_deg", c.pose_sigma_rad, "(0, 90)",
            "standard deviation of the pose's rotation in that measured angle");
  v.Degrees("sigma_deg", c.sigma_rad, "(0, 90)",
            "standard deviation of f_pi_p and f_pi_v (eq19, eq20), besides the measured one");
  v.Number("min_area_m2", c.min_area_m2, "[0, inf)", "smallest area of both planes");
  v.Integer("min_observations", c.min_observations, "[1, 100000]",
            "smallest number of observations of the map plane");
}

/// Adds to `problem` the directions that parallel (eq19) and perpendicular (eq20) planes give:
/// each large matched frame plane against every large landmark but its own, where the measured
/// angle is close to the hypothesis and consistent with it: nearly parallel is not parallel.
/// Soft, as the weights of SP-SLAM (Zhang, Wang, Qi, Liao, Wei 2019) are. In the order of the
/// frame's planes, then of the map's.
void AddParallelPlanes(const Frame& frame, const Map& map, const ParallelConfig& config,
                       PoseProblem& problem);

}  // namespace slam
