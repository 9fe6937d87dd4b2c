#include "sim/trace/lights.h"

#include <algorithm>
#include <cmath>

#include "sim/trace/render_world.h"

namespace sim {
namespace {

/// Nearer to a point that shines it gets no brighter: what real lights have is a size.
constexpr double kNearest_m = 0.01;

}  // namespace

void LightPoints::Start(const std::vector<Light>& lights, const Pose& T_sw) {
  lights_.clear();
  points_w_.clear();
  if (lights.empty()) return;
  const Pose T_ws = Inverse(T_sw);
  for (const Light& light : lights) {
    Shining shining;
    shining.first = points_w_.size();
    AddPoints(light, T_ws);
    shining.last = points_w_.size();
    shining.one_sided = light.kind == LightKind::kArea;
    shining.front_w = T_ws.R * light.half_a_w.cross(light.half_b_w).normalized();
    shining.intensity = light.intensity / static_cast<double>(shining.last - shining.first);
    for (int c = 0; c < 3; ++c) {
      shining.colour[c] = static_cast<float>(light.colour[static_cast<std::size_t>(c)]);
    }
    lights_.push_back(shining);
  }
}

/// A rectangle of n x n cells with a point in each, no two at the same place along either side:
/// an edge that runs along a side hides them one by one. A turned grid, (i, j) ->
/// (i + (j + 1/2) / n, j + (n - i - 1/2) / n) / n: symmetric about the middle, and a and b are
/// not correlated.
void LightPoints::AddPoints(const Light& light, const Pose& T_ws) {
  if (light.kind == LightKind::kLamp) {
    points_w_.push_back(T_ws * light.center_w);
    return;
  }
  const int n = light.samples_per_side;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double a = 2 * (i + (j + 0.5) / n) / n - 1, b = 2 * (j + (n - i - 0.5) / n) / n - 1;
      points_w_.push_back(
          T_ws * Eigen::Vector3d(light.center_w + a * light.half_a_w + b * light.half_b_w));
    }
  }
}

/// False when the light is behind all of the places.
bool LightPoints::FindWays(const Shining& light, const Eigen::Vector3d& point_w,
                           const Spots& spots, Ways& ways) {
  bool any = false;
  for (std::size_t i = 0; i < ways.gain.size(); ++i) {
    ways.rays.Disable(static_cast<int>(i));
    if (!spots.used[i]) continue;
    const Eigen::Vector3d way = point_w - spots.x_w[i];
    const double r2 = way.squaredNorm(), r = std::sqrt(r2);
    // Light falls with the square of the distance, the cosine at the surface and, of a
    // rectangle, that at the light.
    const double from_light = light.one_sided ? -light.front_w.dot(way) : r;
    const double on_surface = spots.shading_n_w[i].dot(way);
    if (!(spots.n_w[i].dot(way) > 0 && from_light > 0 && on_surface > 0)) continue;
    ways.gain[i] = on_surface * from_light / (r2 * std::max(r2, kNearest_m * kNearest_m));
    const Eigen::Vector3d start = spots.x_w[i] + kLeaveSurface_m * spots.n_w[i];
    // It ends before the point, which may itself be on a surface.
    ways.rays.Set(static_cast<int>(i), start, point_w - start, 0.0F,
                  static_cast<float>(1 - kLeaveSurface_m / r));
    any = true;
  }
  return any;
}

void LightPoints::Sum::Add(const Ways& ways,
                           const std::array<bool, RayPacket::kLanes>& blocked) {
  for (std::size_t i = 0; i < gain.size(); ++i) {
    if (!(ways.gain[i] > 0) || blocked[i]) continue;
    gain[i] += ways.gain[i];
    ++seen[i];
  }
}

void LightPoints::Add(std::size_t k, const Sum& sum, LightAtSpots& out) const {
  const Shining& light = lights_[k];
  for (std::size_t i = 0; i < sum.gain.size(); ++i) {
    out.light[i] += static_cast<float>(light.intensity * sum.gain[i]) * light.colour;
    if (2 * sum.seen[i] >= light.last - light.first) out.seen[i] |= 1u << k;
  }
}

}  // namespace sim
