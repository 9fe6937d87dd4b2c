#include "slam/extract/depth_grid.h"

#include "slam/base/require.h"

namespace slam {

DepthGrid MakeDepthGrid(const cv::Mat1f& depth_m, const cv::Mat2d& rays,
                        const DepthNoise& noise, double max_depth_m) {
  Require(depth_m.size() == rays.size(), "MakeDepthGrid: depth and rays differ in size");
  DepthGrid grid;
  grid.width = depth_m.cols, grid.height = depth_m.rows;
  const std::size_t count = depth_m.total();
  grid.x.resize(count), grid.y.resize(count), grid.q.resize(count), grid.g.resize(count);
  const float floor = static_cast<float>(noise.floor_m);
  const float slope = static_cast<float>(noise.linear_per_m);
  const float growth = static_cast<float>(noise.quadratic_per_m);
  const float nearest = static_cast<float>(noise.nearest_m);
  const float farthest = static_cast<float>(max_depth_m);
  std::size_t i = 0;
  for (int v = 0; v < grid.height; ++v) {
    const float* z_row = depth_m[v];
    const cv::Vec2d* ray_row = rays[v];
    for (int u = 0; u < grid.width; ++u, ++i) {
      grid.x[i] = static_cast<float>(ray_row[u][0]);
      grid.y[i] = static_cast<float>(ray_row[u][1]);
      const float z = z_row[u];
      const bool measured = z > 0.0f && z < farthest;  // false for NaN
      const float beyond = std::max(z - nearest, 0.0f);
      const float sigma = floor + (slope + growth * beyond) * beyond;
      grid.q[i] = measured ? 1.0f / z : 0.0f;
      grid.g[i] = measured ? z * z / sigma : 0.0f;
    }
  }
  return grid;
}

}  // namespace slam
