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

}  // namespace slam
