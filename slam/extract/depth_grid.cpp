#include "slam/extract/depth_grid.h"

#include <algorithm>

#include "slam/base/require.h"

namespace slam {
namespace {

void CopyRays(const cv::Mat2d& rays, DepthGrid& grid) {
  const std::size_t count = rays.total();
  grid.x.resize(count), grid.y.resize(count), grid.q.resize(count), grid.g.resize(count);
  std::size_t i = 0;
  for (int v = 0; v < rays.rows; ++v) {
    const cv::Vec2d* row = rays[v];
    for (int u = 0; u < rays.cols; ++u, ++i) {
      grid.x[i] = static_cast<float>(row[u][0]);
      grid.y[i] = static_cast<float>(row[u][1]);
    }
  }
  grid.width = rays.cols, grid.height = rays.rows;
  grid.rays = rays.data;
}

}  // namespace

void FillDepthGrid(const cv::Mat1f& depth_m, const cv::Mat2d& rays, const DepthNoise& noise,
                   double max_depth_m, DepthGrid& grid) {
  Require(depth_m.size() == rays.size(), "FillDepthGrid: depth and rays differ in size");
  if (grid.rays != rays.data || grid.width != rays.cols || grid.height != rays.rows) {
    CopyRays(rays, grid);
  }
  const auto floor = static_cast<float>(noise.floor_m);
  const auto growth = static_cast<float>(noise.quadratic_per_m);
  const auto nearest = static_cast<float>(noise.nearest_m);
  const auto farthest = static_cast<float>(max_depth_m);
  for (int v = 0; v < grid.height; ++v) {
    const float* z_row = depth_m[v];
    float* q = grid.q.data() + grid.Index(0, v);
    float* g = grid.g.data() + grid.Index(0, v);
    for (int u = 0; u < grid.width; ++u) {
      const bool measured = z_row[u] > 0.0f && z_row[u] < farthest;  // false for NaN
      const float z = measured ? z_row[u] : 1.0f;
      const float beyond = std::max(z - nearest, 0.0f);
      const float inverse = 1.0f / z, weight = z * z / (floor + growth * beyond * beyond);
      q[u] = measured ? inverse : 0.0f;
      g[u] = measured ? weight : 0.0f;
    }
  }
}

}  // namespace slam
