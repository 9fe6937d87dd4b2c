#include "slam/pose/factors/box.h"

namespace slam {
namespace {

// Corners farther from the image than its own size are beyond the calibrated part of the lens.
constexpr double kMaxOutside = 1.0;  // image sizes

}  // namespace

Linearised<4> BoxFactor(const BoxConstraint& constraint, const Pose& T_cw,
                        const Camera& camera) {
  Linearised<4> out;
  if (constraint.corners_w.empty()) return out;
  // eta: the box around the projected corners, and the corner that makes each side.
  const Eigen::Vector2d size(camera.width, camera.height);
  std::array<Eigen::Vector3d, 4> extreme_c;
  Eigen::Vector4d eta;
  bool first = true;
  for (const Eigen::Vector3d& p_w : constraint.corners_w) {
    const Eigen::Vector3d x_c = T_cw * p_w;
    if (!(x_c.z() > kMinVisibleDepth_m)) return out;
    const Eigen::Vector2d ideal = camera.Project(x_c);
    const bool near_image = (ideal.array() > -kMaxOutside * size.array()).all() &&
                            (ideal.array() < (1 + kMaxOutside) * size.array()).all();
    if (!near_image) return out;
    const Eigen::Vector2d u = camera.ProjectDistorted(x_c);
    for (int side = 0; side < 4; ++side) {
      const double value = u[side % 2];
      if (first || (side < 2 ? value < eta[side] : value > eta[side])) {
        eta[side] = value;
        extreme_c[static_cast<std::size_t>(side)] = x_c;
      }
    }
    first = false;
  }
  const Eigen::Vector4d observed(constraint.box_obs_px.min.x(), constraint.box_obs_px.min.y(),
                                 constraint.box_obs_px.max.x(), constraint.box_obs_px.max.y());
  for (int side = 0; side < 4; ++side) {
    const auto i = static_cast<std::size_t>(side);
    if (!constraint.use[i]) continue;
    out.r[side] = eta[side] - observed[side];  // eq17
    out.J.row(side) = camera.ProjectDistortedJacobian(extreme_c[i]).row(side % 2) *
                      PointJacobian(extreme_c[i]);
  }
  out.valid = true;
  return out;
}

}  // namespace slam
