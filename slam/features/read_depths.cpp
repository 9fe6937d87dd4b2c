#include "slam/features/read_depths.h"

#include "slam/base/require.h"
#include "slam/features/point_depth.h"

namespace slam {
namespace {

/// Moves a feature, and reads its depth, to where the camera of the middle row would have seen it.
void ToMiddleRow(const Readout& readout, const Pose& T_dc, const cv::Mat1f& depth_m,
                 const Camera& camera, const PointDepthConfig& config, PointFeature& feature) {
  const Eigen::Vector3d ray_r = camera.Backproject(feature.u_px, 1.0);
  const double row_share = camera.RowShare(camera.ProjectDistorted(ray_r).y());
  const Pose T_cr = Inverse(readout.T_rc(row_share));
  double z_m = 0.0;
  if (!depth_m.empty()) z_m = DepthFrom(T_dc * T_cr, depth_m, camera, feature.u_px, config);
  // Without depth it is taken to be far: only the turn moves it.
  const Eigen::Vector3d x_c =
      z_m > 0 ? Eigen::Vector3d(T_cr * (z_m * ray_r)) : Eigen::Vector3d(T_cr.R * ray_r);
  if (!(x_c.z() > kMinVisibleDepth_m)) return;
  feature.u_px = camera.Project(x_c);
  if (z_m > 0) feature.depth_m = x_c.z();
}

}  // namespace

void ReadDepths(const cv::Mat1f& depth_m, const Camera& camera,
                const PointFeatureConfig& config, const Pose& T_dc, const Readout& readout,
                std::vector<PointFeature>& features) {
  Require(depth_m.empty() || (depth_m.cols == camera.width && depth_m.rows == camera.height),
          "ReadDepths: the depth image has not the camera's size");
  for (PointFeature& feature : features) {
    if (!readout.empty()) {
      ToMiddleRow(readout, T_dc, depth_m, camera, config.depth, feature);
    } else if (!depth_m.empty()) {
      feature.depth_m = DepthFrom(T_dc, depth_m, camera, feature.u_px, config.depth);
    }
  }
}

}  // namespace slam
