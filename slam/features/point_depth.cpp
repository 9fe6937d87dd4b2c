#include "slam/features/point_depth.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

namespace slam {

double DepthAt(const cv::Mat1f& depth_m, const Eigen::Vector2d& u_px,
               const PointDepthConfig& config) {
  const int u = static_cast<int>(std::lround(u_px.x()));
  const int v = static_cast<int>(std::lround(u_px.y()));
  if (u < 0 || v < 0 || u >= depth_m.cols || v >= depth_m.rows) return 0.0;
  if (!(depth_m(v, u) > 0)) return 0.0;

  // Collect the measured depths of the square.
  const int w = config.window_px;
  cv::AutoBuffer<float, 64> z(static_cast<std::size_t>((2 * w + 1) * (2 * w + 1)));
  float* end = z.data();
  for (int y = std::max(0, v - w); y <= std::min(depth_m.rows - 1, v + w); ++y) {
    for (int x = std::max(0, u - w); x <= std::min(depth_m.cols - 1, u + w); ++x) {
      if (depth_m(y, x) > 0) *end++ = depth_m(y, x);
    }
  }
  // Two surfaces, or a depth that no sensor measures well: no answer.
  std::sort(z.data(), end);
  const double step = *(end - 1) - z[0];
  const double median = z[static_cast<std::size_t>((end - z.data()) / 2)];
  if (!(step <= std::max(config.max_step_m, config.max_step_ratio * median))) return 0.0;
  if (!(median >= config.min_depth_m && median <= config.max_depth_m)) return 0.0;
  return median;
}

double DepthFrom(const Pose& T_dc, const cv::Mat1f& depth_m, const Camera& camera,
                 const Eigen::Vector2d& u_px, const PointDepthConfig& config) {
  // At the same pixel the depth image shows the point or one near it: enough to say where in that
  // image the point is.
  const Eigen::Vector3d ray = camera.Backproject(u_px, 1.0);
  const double about_m = DepthAt(depth_m, camera.ProjectDistorted(ray), config);
  if (!(about_m > 0)) return 0.0;
  const Eigen::Vector3d about_d = T_dc * (about_m * ray);
  if (!(about_d.z() > kMinVisibleDepth_m)) return 0.0;
  // Its depth there, and how far along the ray of now it has that depth.
  const double there_m = DepthAt(depth_m, camera.ProjectDistorted(about_d), config);
  if (!(there_m > 0)) return 0.0;
  return (there_m - T_dc.t.z()) / T_dc.R.row(2).dot(ray);
}

}  // namespace slam
