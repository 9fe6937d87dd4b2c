#include "sim/truth/surface_end.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace sim {

SurfaceEnds::SurfaceEnds(std::span<const Triangle> triangles) : caster_(triangles) {
  for (const Triangle& triangle : triangles) corners_w_.push_back(triangle.corners_w);
}

bool SurfaceEnds::At(const Pose& T_wc, const Eigen::Vector3d& x_w) const {
  const Eigen::Vector3d x_c = Inverse(T_wc) * x_w;
  for (int k = 0; k < kDirections; ++k) {
    // Odd multiples of a 32nd turn: along no edge of a box that is square to the image.
    const double turn = (2 * k + 1) * std::numbers::pi / kDirections;
    const Eigen::Vector3d beside(std::cos(turn), std::sin(turn), 0);
    const Eigen::Vector3d ray_c = x_c / x_c.z() + kBeside * beside;
    const ExactHit hit = caster_.Nearest(T_wc.t, T_wc.R * ray_c, 0.0);
    if (hit.triangle < 0) return true;
    if (hit.distance <= x_c.z() + kBreak_m) continue;
    // A face that is seen nearly edge-on runs away fast, but from the very point.
    const auto& [a, b, c] = corners_w_[static_cast<std::size_t>(hit.triangle)];
    const Eigen::Vector3d n_w = (b - a).cross(c - a).normalized();
    if (std::abs(n_w.dot(x_w - a)) > kBreak_m / 2) return true;
  }
  return false;
}

}  // namespace sim
