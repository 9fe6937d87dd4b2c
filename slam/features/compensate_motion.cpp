#include "slam/features/compensate_motion.h"

namespace slam {
namespace {

/// What moves a feature: the row's camera and the depth camera as seen from the middle row's.
struct Cameras {
  Readout readout;
  Pose T_dc;
};

/// Moves a feature that was compensated with the one set of cameras to where the other puts it.
void MoveFeature(const Camera& camera, const Cameras& before, const Cameras& now,
                 PointFeature& feature) {
  const bool has_depth = feature.depth_m > 0;
  const Eigen::Vector3d x_c =
      camera.Backproject(feature.u_px, has_depth ? feature.depth_m : 1.0);
  const auto moved = [has_depth](const Pose& T, const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return has_depth ? T * x : Eigen::Vector3d(T.R * x);
  };

  // Where it was read: the row is nearly that in which the middle row's camera sees it.
  Eigen::Vector3d x_r = x_c;
  double share = 0.0;
  for (int k = 0; k < 3; ++k) {
    share = camera.RowShare(camera.ProjectDistorted(x_r).y());
    x_r = moved(before.readout.T_rc(share), x_c);
    if (!(x_r.z() > kMinVisibleDepth_m)) return;
  }

  // The depth image says the same depth, measured from elsewhere.
  const Pose T_cr = Inverse(now.readout.T_rc(share));
  if (has_depth) {
    const double z_d_m = (before.T_dc * x_c).z();
    const Pose T_dr = now.T_dc * T_cr;
    const Eigen::Vector3d ray = x_r / x_r.z();
    x_r = (z_d_m - T_dr.t.z()) / T_dr.R.row(2).dot(ray) * ray;
  }
  const Eigen::Vector3d moved_c = moved(T_cr, x_r);
  if (!(moved_c.z() > kMinVisibleDepth_m)) return;
  feature.u_px = camera.Project(moved_c);
  if (has_depth) feature.depth_m = moved_c.z();
}

}  // namespace

bool CompensateMotion(const Camera& camera, const Vector6d& speed, Frame& frame) {
  if (frame.readout.empty() && frame.depth_late_s == 0.0) return false;
  const Cameras before{frame.readout, frame.T_dc()};
  frame.speed.mean = speed;
  frame.readout.speed = speed;
  const Cameras now{frame.readout, frame.T_dc()};
  for (PointFeature& feature : frame.features) MoveFeature(camera, before, now, feature);
  return true;
}

}  // namespace slam
