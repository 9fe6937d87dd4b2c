#include "slam/pose/factors/point.h"

namespace slam {

Linearised<3> PointFactor(const PointConstraint& constraint, const Pose& T_cw,
                          const Camera& camera, double bf_px_m) {
  Linearised<3> out;
  const Eigen::Vector3d x_c = T_cw * constraint.p_w;
  const double x = x_c.x(), y = x_c.y(), z = x_c.z();
  if (!(z > kMinProjectedDepth_m)) return out;
  const double iz = 1.0 / z, iz2 = iz * iz;
  const double fx = camera.fx, fy = camera.fy;
  const double u = fx * x * iz + camera.cx;
  out.r[0] = u - constraint.u_px.x();  // eq14
  out.r[1] = fy * y * iz + camera.cy - constraint.u_px.y();
  out.J.row(0) << fx * iz, 0, -fx * x * iz2, -fx * x * y * iz2, fx * (1 + x * x * iz2),
      -fx * y * iz;
  out.J.row(1) << 0, fy * iz, -fy * y * iz2, -fy * (1 + y * y * iz2), fy * x * y * iz2,
      fy * x * iz;
  if (constraint.right_u_px >= 0) {
    out.r[2] = u - bf_px_m * iz - constraint.right_u_px;
    // d(bf/z) = -bf/z^2 dz with dz = rho_z + omega_x y - omega_y x.
    const double g = bf_px_m * iz2;
    out.J.row(2) = out.J.row(0);
    out.J(2, 2) += g;
    out.J(2, 3) += g * y;
    out.J(2, 4) -= g * x;
  }
  out.valid = true;
  return out;
}

}  // namespace slam
