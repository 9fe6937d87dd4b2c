#include "eval/export/silhouette.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eval {
namespace {

/// A corner nearer than this projects anywhere.
constexpr double kNear_m = 0.01;

/// The ray o + t d, t > 0, meets the box |x| <= half.
bool Meets(const Eigen::Vector3d& o, const Eigen::Vector3d& d, const Eigen::Vector3d& half) {
  double first = 0, last = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0) {
      if (std::abs(o[axis]) > half[axis]) return false;
      continue;
    }
    const double a = (-half[axis] - o[axis]) / d[axis], b = (half[axis] - o[axis]) / d[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

/// Where on the canvas the box can be.
cv::Rect Bounds(const Camera& camera, const Pose& T_co, const Eigen::Vector3d& half) {
  const cv::Rect canvas(-camera.width, -camera.height, 3 * camera.width, 3 * camera.height);
  double u0 = 1e9, v0 = 1e9, u1 = -1e9, v1 = -1e9;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                               (corner & 4) != 0 ? 1 : -1);
    const Eigen::Vector3d p_c = T_co * sign.cwiseProduct(half);
    if (p_c.z() < kNear_m) return canvas;
    const double u = camera.fx * p_c.x() / p_c.z() + camera.cx;
    const double v = camera.fy * p_c.y() / p_c.z() + camera.cy;
    u0 = std::min(u0, u), u1 = std::max(u1, u);
    v0 = std::min(v0, v), v1 = std::max(v1, v);
  }
  const auto whole = [](double x) {
    return static_cast<int>(std::clamp(std::floor(x), -1e6, 1e6));
  };
  return canvas &
         cv::Rect(whole(u0), whole(v0), whole(u1) - whole(u0) + 2, whole(v1) - whole(v0) + 2);
}

}  // namespace

Silhouette BoxSilhouette(const Camera& camera, const Pose& T_co,
                         const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d half = size_m / 2;
  const Pose T_oc = Inverse(T_co);
  Silhouette silhouette{cv::Mat1b(camera.height, camera.width, uchar{0}), {}};
  const cv::Rect image(0, 0, camera.width, camera.height);
  const cv::Rect bounds = Bounds(camera, T_co, half);
  for (int v = bounds.y; v < bounds.y + bounds.height; ++v) {
    for (int u = bounds.x; u < bounds.x + bounds.width; ++u) {
      const Eigen::Vector3d ray_c((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
      if (!Meets(T_oc.t, T_oc.R * ray_c, half)) continue;
      silhouette.all.Add(u, v);
      if (image.contains({u, v})) silhouette.mask(v, u) = 255;
    }
  }
  return silhouette;
}

}  // namespace eval
