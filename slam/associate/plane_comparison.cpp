#include "slam/associate/plane_comparison.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace slam {
namespace {

// A map plane without an estimate (a map made by hand) is trusted this much.
constexpr double kDefaultOffsetSigma_m = 0.003;
constexpr double kDefaultAngleSigma_rad = 0.01;

/// Covariance of (height at x, slope along e_1, slope along e_2) of one plane.
using Covariance3 = Eigen::Matrix3d;

Covariance3 FloorOf(const AssociationConfig& config) {
  const double z2 = config.offset_floor_m * config.offset_floor_m;
  const double s2 = config.angle_floor_rad * config.angle_floor_rad;
  return Eigen::Vector3d(z2, s2, s2).asDiagonal();
}

/// A patch with independent height at its centroid and slopes, at a point `lever` away from it.
Covariance3 PatchCovariance(double offset_sigma_m, double angle_sigma_rad,
                            const Eigen::Vector2d& lever) {
  Eigen::Matrix3d L = Eigen::Matrix3d::Identity();
  L(0, 1) = lever.x();
  L(0, 2) = lever.y();
  const double z2 = offset_sigma_m * offset_sigma_m, s2 = angle_sigma_rad * angle_sigma_rad;
  return L * Eigen::Vector3d(z2, s2, s2).asDiagonal() * L.transpose();
}

/// A frame plane's own, with what the sensor bends.
Covariance3 PatchCovariance(const FramePlane& f, const Eigen::Vector2d& lever) {
  return PatchCovariance(f.OffsetSigma_m(), f.AngleSigma_rad(), lever);
}

/// Same for a map plane at x_w, slopes along `axes_w`.
Covariance3 MapCovariance(const MapPlane& m, const Eigen::Vector3d& x_w,
                          const Eigen::Matrix<double, 3, 2>& axes_w) {
  if (m.estimate.empty()) {
    return PatchCovariance(kDefaultOffsetSigma_m, kDefaultAngleSigma_rad,
                           axes_w.transpose() * (x_w - m.centroid_w));
  }
  Eigen::Matrix3d L = Eigen::Matrix3d::Zero();
  L.row(0) = m.estimate.Lever(x_w).transpose();
  L.bottomRightCorner<2, 2>() = axes_w.transpose() * m.estimate.axes;
  return L * m.estimate.Covariance() * L.transpose();
}

/// Height and slopes of plane `pi` over plane `base` at x, along base's tangent `axes`.
PlaneComparison Compare(const Plane& pi, const Eigen::Vector3d& x, const Plane& base,
                        const Eigen::Matrix<double, 3, 2>& axes,
                        const Covariance3& covariance) {
  PlaneComparison out;
  out.angle_rad = Angle(pi.n, base.n);                      // eq6
  out.offset_m = SignedDistance(base, ProjectOnto(pi, x));  // eq7
  out.offset_sigma_m = std::sqrt(covariance(0, 0));
  // Slopes as the sine-direction times the angle: finite for every pair of normals.
  const Eigen::Vector2d sine = -(axes.transpose() * pi.n);
  const double s = sine.norm();
  const Eigen::Vector2d slope = s > 0 ? Eigen::Vector2d(sine * (out.angle_rad / s)) : sine;
  const Eigen::Vector3d r(out.offset_m, slope.x(), slope.y());
  out.chi2 = r.dot(covariance.ldlt().solve(r));
  out.log_spread = std::log(covariance.determinant());
  return out;
}

}  // namespace

PlaneComparison ComparePlanes(const FramePlane& f, const MapPlane& m, const UncertainPose& pose,
                              const AssociationConfig& config) {
  // Everything in the camera frame, where the patch was measured.
  const Plane map_pi_c = Transform(pose.T_cw, m.pi_w);
  const Eigen::Matrix<double, 3, 2> axes_c = TangentBasis(map_pi_c.n);
  const Eigen::Vector3d x_c = ProjectOnto(f.pi_c, f.centroid_c);
  const Eigen::Vector3d x_w = pose.T_cw.R.transpose() * (x_c - pose.T_cw.t);
  // Everybody's uncertainty: errors that do not average out, patch, map plane there, and pose.
  Covariance3 covariance = FloorOf(config);
  covariance += PatchCovariance(f, Eigen::Vector2d::Zero());
  const double own_spread = std::log(covariance.determinant());
  covariance += MapCovariance(m, x_w, pose.T_cw.R.transpose() * axes_c);
  // d (height, slopes) / d xi: the map plane moves in the camera frame by -n.rho and turns.
  Eigen::Matrix<double, 3, 6> J = Eigen::Matrix<double, 3, 6>::Zero();
  J.topLeftCorner<1, 3>() = -map_pi_c.n.transpose();
  J.topRightCorner<1, 3>() = map_pi_c.n.cross(x_c).transpose();
  J.block<1, 3>(1, 3) = map_pi_c.n.cross(axes_c.col(0)).transpose();
  J.block<1, 3>(2, 3) = map_pi_c.n.cross(axes_c.col(1)).transpose();
  covariance += J * pose.covariance * J.transpose();
  PlaneComparison out = Compare(f.pi_c, x_c, map_pi_c, axes_c, covariance);
  out.log_spread -= own_spread;
  return out;
}

PlaneComparison ComparePlanes(const FramePlane& one, const FramePlane& other,
                              const AssociationConfig& config) {
  const Eigen::Matrix<double, 3, 2> axes = TangentBasis(other.pi_c.n);
  Covariance3 covariance = 2 * FloorOf(config);
  covariance += PatchCovariance(one, Eigen::Vector2d::Zero());
  covariance += PatchCovariance(other, axes.transpose() * (one.centroid_c - other.centroid_c));
  return Compare(one.pi_c, one.centroid_c, other.pi_c, axes, covariance);
}

PlaneComparison ComparePlanes(const MapPlane& one, const MapPlane& other) {
  const Eigen::Matrix<double, 3, 2> axes = TangentBasis(other.pi_w.n);
  const Covariance3 covariance =
      MapCovariance(one, one.centroid_w, axes) + MapCovariance(other, one.centroid_w, axes);
  return Compare(one.pi_w, one.centroid_w, other.pi_w, axes, covariance);
}

}  // namespace slam
