#include "slam/pose/pose_error.h"

namespace slam {
namespace {

/// Mean distance of the planes' middles along the optical axis; 0 without planes.
double PlaneDepth_m(const Frame& frame) {
  double sum_m = 0.0;
  for (const FramePlane& plane : frame.planes) sum_m += plane.centroid_c.z();
  return frame.planes.empty() ? 0.0 : sum_m / static_cast<double>(frame.planes.size());
}

}  // namespace

Matrix6d BendCovariance(const Frame& frame) {
  const double lift_m = frame.bend_ratio * PlaneDepth_m(frame), tilt_rad = frame.bend_ratio;
  const double m2 = lift_m * lift_m, rad2 = tilt_rad * tilt_rad;
  return (Vector6d() << m2, m2, m2, rad2, rad2, rad2).finished().asDiagonal();
}

Matrix6d ShutterCovariance(const Frame& frame) {
  // The outermost rows are read half of the time before and after the middle one.
  const double half_s = 0.5 * frame.readout.sigma_s;
  const double shift_m = half_s * frame.readout.speed.head<3>().norm();
  const double turn_rad = half_s * frame.readout.speed.tail<3>().norm();
  const double m2 = shift_m * shift_m, rad2 = turn_rad * turn_rad;
  return (Vector6d() << m2, m2, m2, rad2, rad2, rad2).finished().asDiagonal();
}

Matrix6d PoseErrorCovariance(const Frame& frame) {
  if (!frame.pose_covariance) return Matrix6d::Zero();
  return *frame.pose_covariance + BendCovariance(frame) + ShutterCovariance(frame);
}

}  // namespace slam
