#include "slam/mapping/plane_evidence.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace slam {

double SharedBend(const FramePlane& plane, const Frame& frame) {
  if (!frame.T_lc) return 1.0;
  constexpr double kStill_rad = 2e-4;  // a thousandth of that: the factor stays finite at rest
  const double moved_rad =
      Eigen::AngleAxisd(frame.T_lc->R).angle() + frame.T_lc->t.norm() / plane.centroid_c.norm();
  return std::max(1.0, kViewOfOneBend_rad / std::max(moved_rad, kStill_rad));
}

void AddEvidence(PlaneEstimate& estimate_a, const FramePlane& plane, const Frame& frame,
                 const Pose& T_ac, double keep, double world_variance_m2) {
  const double share = estimate_a.empty() ? 1.0 : std::sqrt(SharedBend(plane, frame));
  AddObservation(estimate_a, Transform(T_ac, plane.pi_c), T_ac * plane.centroid_c,
                 std::hypot(plane.angle_sigma_rad, share * plane.bend_angle_sigma_rad),
                 std::hypot(plane.offset_sigma_m, share * plane.bend_offset_sigma_m), keep,
                 world_variance_m2);
}

PlaneEvidence BestKnown(const PlaneEstimate& estimate) {
  // Where the height does not depend on the slopes.
  const Eigen::Matrix3d covariance = estimate.Covariance();
  const Eigen::Vector2d best =
      -covariance.bottomRightCorner<2, 2>().ldlt().solve(covariance.block<2, 1>(1, 0));
  const Eigen::Vector3d x = estimate.origin_w + estimate.axes * best;
  const Eigen::Vector3d lever = estimate.Lever(x);
  const Plane pi = estimate.Mean();
  return {pi, ProjectOnto(pi, x), std::sqrt(PlaneEstimate::WorstSlopeVariance(covariance)),
          std::sqrt(lever.dot(covariance * lever))};
}

}  // namespace slam
