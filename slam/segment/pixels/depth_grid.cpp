#include "slam/segment/pixels/depth_grid.h"

#include <algorithm>

#include "slam/base/lane_math.h"
#include "slam/base/require.h"

namespace slam {
namespace {

struct FloatNoise {
  float floor, slope, growth, nearest, farthest;
};

/// Eight pixels of a row, or one.
template <typename Number>
SLAM_INLINE void SetDepthAt(Number z, const FloatNoise& noise, float* q, float* g) {
  const Number zero{};
  const auto measured = (z > zero) & (z < zero + noise.farthest);  // false for NaN
  const Number above = z - noise.nearest;
  const Number beyond = above > zero ? above : zero;
  const Number sigma = noise.floor + (noise.slope + noise.growth * beyond) * beyond;
  Store(measured ? 1.0f / z : zero, q);
  Store(measured ? z * z / sigma : zero, g);
}

}  // namespace

SLAM_LANES static void SetDepthRow(const float* z, int count, const FloatNoise& noise, float* q,
                                   float* g) {
  const FloatNoise in_float = noise;  // what is written cannot change it
  int u = 0;
  for (; u + kLanes <= count; u += kLanes) SetDepthAt(Lanes(z + u), in_float, q + u, g + u);
  for (; u < count; ++u) SetDepthAt(z[u], in_float, q + u, g + u);
}

/// Sets column_x if that is all there is in x.
static void FindSharedRays(DepthGrid& grid) {
  grid.column_x.clear();
  const auto width = static_cast<std::ptrdiff_t>(grid.width);
  for (std::ptrdiff_t v = 0; v < grid.height; ++v) {
    const auto x = grid.x.begin() + v * width, y = grid.y.begin() + v * width;
    if (!std::equal(x, x + width, grid.x.begin())) return;
    if (std::any_of(y, y + width, [y](float other) { return other != *y; })) return;
  }
  grid.column_x.assign(grid.x.begin(), grid.x.begin() + width);
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
  FindSharedRays(grid);
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

}  // namespace slam
