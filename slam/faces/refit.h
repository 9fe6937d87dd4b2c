#pragma once

#include "slam/base/chi_square.h"
#include "slam/base/field_visitor.h"
#include "slam/geometry/sensor_model.h"
#include "slam/model/frame_plane.h"

namespace slam {

/// Which estimate a re-fit ends with.
enum class RefitMethod {
  kPcl,       ///< PCL's robust fit, refined on its inliers with equal weights (as the paper)
  kWeighted,  ///< least squares under the depth noise on the inliers of PCL's robust fit
  kBest  ///< the segment's own fit unless kWeighted explains the points significantly better
};

struct RefitConfig {
  RefitMethod method = RefitMethod::kBest;
  double max_inlier_sigmas = 2.5;  // 1 in 80 is farther off
  int max_sample_points = 300;
  int max_iterations = 100;
  double min_improvement_chi2 = kChi2Of3At999;  // the segment's fit rests on all pixels
  double max_edge_sigmas = 4.0;                 // 1 in 16,000 is farther off
};

inline void VisitFields(RefitConfig& c, FieldVisitor& v) {
  v.Named("method", c.method, {"pcl", "weighted", "best"},
          "which fit is kept: PCL's, the one weighted by depth noise, or the best");
  v.Number("max_inlier_sigmas", c.max_inlier_sigmas, "(0, inf)",
           "largest distance of an inlier from the plane, in standard deviations of the depth");
  v.Integer("max_sample_points", c.max_sample_points, "[3, 1000000]",
            "largest number of points given to the robust fit");
  v.Integer("max_iterations", c.max_iterations, "[1, 1000000]",
            "number of hypotheses of the robust fit");
  v.Number("min_improvement_chi2", c.min_improvement_chi2, "[0, inf)",
           "chi-square (3 degrees of freedom) that a re-fit must gain to replace the "
           "segment's fit");
  v.Number("max_edge_sigmas", c.max_edge_sigmas, "(0, inf)",
           "largest distance of an edge point from the plane, in standard deviations of the "
           "depth");
}

/// Fits a plane again, robustly, to its thinned points, and cleans its edge points.
///
/// MSAC of PCL (fixed seed), then least squares on its inliers in inverse depth with the
/// weights of the noise model (plane_sums.h). Sets pi_c (facing the camera), inlier_ratio
/// (share of points_c within max_inlier_sigmas of noise and bend: what the sensor bends is flat),
/// drops points off the plane by more than noise from points_c, drops edge
/// points off the plane, moves the others along their rays onto it, and sets box_px to bound
/// them. A plane with fewer than 3 points keeps its parameters and gets inlier ratio 0.
///
/// Source: PAS-SLAM, Plane Re-fitting. Deterministic.
void RefitPlane(FramePlane& plane, const SensorModel& sensor, const RefitConfig& config);

}  // namespace slam
