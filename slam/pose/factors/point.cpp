#include "slam/pose/factors/point.h"

namespace slam {

PointResidual ResidualOf(const PointConstraint& constraint, const Eigen::Vector3d& x_c,
                         const Camera& camera) {
  PointResidual out;
  if (!(x_c.z() > kMinProjectedDepth_m)) return out;
  const double iz = 1.0 / x_c.z(), weight = 1.0 / constraint.sigma_px;
  const double x = x_c.x() * iz, y = x_c.y() * iz;
  const double fx = weight * camera.fx, fy = weight * camera.fy;
  out.r[0] = fx * x + weight * (camera.cx - constraint.u_px.x());  // eq14
  out.r[1] = fy * y + weight * (camera.cy - constraint.u_px.y());
  out.by_x_c << fx * iz, 0, -fx * x * iz,  //
      0, fy * iz, -fy * y * iz,            //
      0, 0, 0;
  if (constraint.depth_m > 0) {
    const double scale = constraint.depth_m / constraint.depth_sigma_m;
    out.r[2] = scale * (constraint.depth_m * iz - 1.0);
    out.by_x_c(2, 2) = -scale * constraint.depth_m * iz * iz;
  }
  out.valid = true;
  return out;
}

Linearised<3> PointFactor(const PointConstraint& constraint, const Pose& T_cw,
                          const Camera& camera) {
  const Eigen::Vector3d x_c = T_cw * constraint.p_w;
  const PointResidual residual = ResidualOf(constraint, x_c, camera);
  if (!residual.valid) return {};
  return {residual.r, residual.by_x_c * PointJacobian(x_c), true};
}

}  // namespace slam
