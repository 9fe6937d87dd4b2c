#include "sim/trace/image_rays.h"

#include <algorithm>

namespace sim {
namespace {

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

}  // namespace

ImageRays::ImageRays(const Camera& camera) : camera_(camera) {
  Bound();
  if (camera.lens.IsNone()) {
    for (int u = 0; u < camera.width; ++u) x_.push_back(camera.Ray(u, 0).x());
    for (int v = 0; v < camera.height; ++v) y_.push_back(camera.Ray(0, v).y());
    return;
  }
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.Ray(u, v);
      x_.push_back(ray.x());
      y_.push_back(ray.y());
    }
  }
}

void ImageRays::Bound() {
  constexpr double kRim_px = 2.0;  // as far as WithLens makes sure of
  const double right = camera_.width - 1 + kRim_px, bottom = camera_.height - 1 + kRim_px;
  window_.low = window_.high = camera_.Ray(-kRim_px, -kRim_px).head<2>();
  const auto include = [&](double u, double v) {
    const Eigen::Vector2d ray = camera_.Ray(u, v).head<2>();
    window_.low = window_.low.cwiseMin(ray);
    window_.high = window_.high.cwiseMax(ray);
  };
  for (double u = -kRim_px; u <= right; u += 1) include(u, -kRim_px), include(u, bottom);
  for (double v = -kRim_px; v <= bottom; v += 1) include(-kRim_px, v), include(right, v);
}

void ImageRays::Stretch(int v, int first, int last, double* x, double* y) const {
  const int count = last - first;
  if (camera_.lens.IsNone()) {
    std::copy_n(x_.data() + first, count, x);
    std::fill_n(y, count, y_[Index(v)]);
    return;
  }
  const std::size_t from = Index(v) * Index(camera_.width) + Index(first);
  std::copy_n(x_.data() + from, count, x);
  std::copy_n(y_.data() + from, count, y);
}

Eigen::Vector3d ImageRays::At(int u, int v) const {
  if (camera_.lens.IsNone()) return {x_[Index(u)], y_[Index(v)], 1.0};
  const std::size_t i = Index(v) * Index(camera_.width) + Index(u);
  return {x_[i], y_[i], 1.0};
}

Eigen::Vector3d ImageRays::Beside(int u, int v, double du, double dv) const {
  if (camera_.lens.IsNone()) return camera_.Ray(u + du, v + dv);
  const int u0 = std::max(u - 1, 0), u1 = std::min(u + 1, camera_.width - 1);
  const int v0 = std::max(v - 1, 0), v1 = std::min(v + 1, camera_.height - 1);
  return At(u, v) + du / (u1 - u0) * (At(u1, v) - At(u0, v)) +
         dv / (v1 - v0) * (At(u, v1) - At(u, v0));
}

}  // namespace sim
