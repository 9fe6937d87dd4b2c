#pragma once

#include "slam/base/field_visitor.h"
#include "slam/geometry/depth_noise.h"
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
  double max_inlier_sigmas = 2.5;  ///< distance of an inlier, in sigmas of the depth; (0, inf)
  int max_sample_points = 300;     ///< points given to the robust fit; domain [3, inf)
  int max_iterations = 100;        ///< hypotheses of the robust fit; domain [1, inf)
  /// How much less the squared error of the re-fit must be, in sigmas^2, before it replaces the
  /// segment's fit, which rests on all pixels; chi-square, 3 degrees of freedom. Domain [0,
  /// inf).
  double min_improvement_chi2 = 16.3;
  double max_edge_sigmas = 4.0;  ///< distance of an edge point that is kept; domain (0, inf)
};

inline void VisitFields(RefitConfig& c, FieldVisitor& v) {
  v.Named("method", c.method, {"pcl", "weighted", "best"}, "which fit is kept");
  v.Number("max_inlier_sigmas", c.max_inlier_sigmas, "(0, inf)", "distance of an inlier");
  v.Integer("max_sample_points", c.max_sample_points, "[3, 1000000]",
            "given to the robust fit");
  v.Integer("max_iterations", c.max_iterations, "[1, 1000000]", "of the robust fit");
  v.Number("min_improvement_chi2", c.min_improvement_chi2, "[0, inf)",
           "before a re-fit replaces the fit");
  v.Number("max_edge_sigmas", c.max_edge_sigmas, "(0, inf)",
           "distance of an edge point that is kept");
}

/// Fits a plane again, robustly, to its thinned points, and cleans its edge points.
///
/// MSAC of PCL (fixed seed), then least squares on its inliers in inverse depth with the
/// weights of the noise model (plane_sums.h). Sets pi_c (facing the camera), inlier_ratio
/// (share of points_c within max_inlier_sigmas), drops outliers from points_c, drops edge
/// points off the plane, moves the others along their rays onto it, and sets box_px to bound
/// them. A plane with fewer than 3 points keeps its parameters and gets inlier ratio 0.
///
/// Source: PAS-SLAM, Plane Re-fitting. Deterministic.
void RefitPlane(FramePlane& plane, const DepthNoise& noise, const RefitConfig& config);

}  // namespace slam
