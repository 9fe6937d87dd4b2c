#include "slam/pose/factors/box.h"

namespace slam {
namespace {

// Corners farther from the image than its own size are beyond the calibrated part of the lens.
constexpr double kMaxOutside = 1.0;  // image sizes

/// d (recorded pixel) / d x_c, Brown's distortion included.
Eigen::Matrix<double, 2, 3> ProjectionJacobian(const Camera& k, const Eigen::Vector3d& x_c) {
  const double iz = 1.0 / x_c.z(), x = x_c.x() * iz, y = x_c.y() * iz;
  Eigen::Matrix2d D = Eigen::Matrix2d::Identity();
  if (k.distorted()) {
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (k.k1 + r2 * (k.k2 + r2 * k.k3));
    const double slope = 2 * (k.k1 + r2 * (2 * k.k2 + r2 * 3 * k.k3));
    D(0, 0) = radial + slope * x * x + 2 * k.p1 * y + 6 * k.p2 * x;
    D(0, 1) = D(1, 0) = slope * x * y + 2 * k.p1 * x + 2 * k.p2 * y;
    D(1, 1) = radial + slope * y * y + 6 * k.p1 * y + 2 * k.p2 * x;
  }
  Eigen::Matrix<double, 2, 3> N;
  N << iz, 0, -x * iz, 0, iz, -y * iz;
  return Eigen::Vector2d(k.fx, k.fy).asDiagonal() * D * N;
}

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
    out.J.row(side) =
        ProjectionJacobian(camera, extreme_c[i]).row(side % 2) * PointJacobian(extreme_c[i]);
  }
  out.valid = true;
  return out;
}

}  // namespace slam
