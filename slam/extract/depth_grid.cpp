#include "slam/extract/depth_grid.h"

#include <algorithm>

#include "slam/base/lanes.h"
#include "slam/base/require.h"

namespace slam {
namespace {

struct FloatNoise {
  float floor, slope, growth, nearest, farthest;
};

}  // namespace

SLAM_LANES static void SetDepthRow(const float* __restrict z_row, int count,
                                   const FloatNoise& noise, float* __restrict q,
                                   float* __restrict g) {
  for (int u = 0; u < count; ++u) {
    const float z = z_row[u];
    const bool measured = z > 0.0f && z < noise.farthest;  // false for NaN
    const float beyond = z - noise.nearest > 0.0f ? z - noise.nearest : 0.0f;
    const float sigma = noise.floor + (noise.slope + noise.growth * beyond) * beyond;
    q[u] = measured ? 1.0f / z : 0.0f;
    g[u] = measured ? z * z / sigma : 0.0f;
  }
}

void SetRays(const cv::Mat2d& rays, DepthGrid& grid) {
  grid.width = rays.cols, grid.height = rays.rows;
  const std::size_t count = rays.total();
  grid.x.resize(count), grid.y.resize(count), grid.q.resize(count), grid.g.resize(count);
  std::size_t i = 0;
  for (int v = 0; v < grid.height; ++v) {
    const cv::Vec2d* ray_row = rays[v];
    for (int u = 0; u < grid.width; ++u, ++i) {
      grid.x[i] = static_cast<float>(ray_row[u][0]);
      grid.y[i] = static_cast<float>(ray_row[u][1]);
    }
  }
}

void SetDepth(const cv::Mat1f& depth_m, const DepthNoise& noise, double max_depth_m,
              DepthGrid& grid) {
  Require(depth_m.cols == grid.width && depth_m.rows == grid.height,
          "SetDepth: depth and rays differ in size");
  const FloatNoise in_float{
      static_cast<float>(noise.floor_m), static_cast<float>(noise.linear_per_m),
      static_cast<float>(noise.quadratic_per_m), static_cast<float>(noise.nearest_m),
      static_cast<float>(max_depth_m)};
  for (int v = 0; v < grid.height; ++v) {
    const auto start = static_cast<std::size_t>(grid.Index(0, v));
    SetDepthRow(depth_m[v], grid.width, in_float, grid.q.data() + start, grid.g.data() + start);
  }
}

DepthGrid MakeDepthGrid(const cv::Mat1f& depth_m, const cv::Mat2d& rays,
                        const DepthNoise& noise, double max_depth_m) {
  DepthGrid grid;
  SetRays(rays, grid);
  SetDepth(depth_m, noise, max_depth_m, grid);
  return grid;
}

}  // namespace slam
