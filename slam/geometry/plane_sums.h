#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "slam/geometry/depth_noise.h"
#include "slam/geometry/plane.h"

namespace slam {

/// A plane as a function of the ray: inverse depth 1/z = a x + b y + c at the ray (x, y, 1).
/// n = -(a, b, c) / |(a, b, c)|, d = 1 / |(a, b, c)|, so it faces the camera.
struct InverseDepthPlane {
  double a = 0.0, b = 0.0, c = 0.0;  ///< 1/metres

  double InverseDepth(double x, double y) const { return a * x + b * y + c; }
  /// Requires (a, b, c) != 0.
  Plane Hessian() const {
    const Eigen::Vector3d abc(a, b, c);
    const double norm = abc.norm();
    return {-abc / norm, 1.0 / norm};
  }
  /// Cosine of the angle between the normal and the ray (x, y, 1).
  double Cosine(double x, double y) const {
    return InverseDepth(x, y) / std::sqrt((a * a + b * b + c * c) * (x * x + y * y + 1.0));
  }
};

/// The plane of pi_c as seen along rays; requires d > 0.
inline InverseDepthPlane SeenAlongRays(const Plane& pi_c) {
  const Eigen::Vector3d abc = -pi_c.n / pi_c.d;
  return {abc.x(), abc.y(), abc.z()};
}

/// Sums that make the weighted least-squares plane of a set of pixels, and merge exactly.
///
/// A pixel is its ray (x, y), inverse depth q = 1/z and weight w = (z^2 / sigma(z))^2 =
/// 1/sigma_q^2: the noise is along the ray and in q, in which a plane is linear, so the fit is
/// a linear regression without bias from errors in x and y, and its error sum is a chi-square.
struct PlaneSums {
  double n = 0, w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0, wyy = 0, wq = 0, wqx = 0, wqy = 0,
         wqq = 0;

  void Add(double x, double y, double q, double weight) {
    const double vx = weight * x, vy = weight * y, vq = weight * q;
    n += 1, w += weight, wx += vx, wy += vy, wq += vq;
    wxx += vx * x, wxy += vx * y, wyy += vy * y, wqx += vq * x, wqy += vq * y, wqq += vq * q;
  }
  PlaneSums& operator+=(const PlaneSums& o) {
    n += o.n, w += o.w, wx += o.wx, wy += o.wy, wxx += o.wxx, wxy += o.wxy, wyy += o.wyy;
    wq += o.wq, wqx += o.wqx, wqy += o.wqy, wqq += o.wqq;
    return *this;
  }
  /// Takes out pixels that are among these.
  PlaneSums& operator-=(const PlaneSums& o) {
    n -= o.n, w -= o.w, wx -= o.wx, wy -= o.wy, wxx -= o.wxx, wxy -= o.wxy, wyy -= o.wyy;
    wq -= o.wq, wqx -= o.wqx, wqy -= o.wqy, wqq -= o.wqq;
    return *this;
  }
};

/// The fitted plane and its error sum_i w_i (q_i - q(x_i, y_i))^2: a sum of squares in units of
/// the noise, about n - 3 when the surface is a plane.
struct PlaneFit {
  InverseDepthPlane plane;
  double error = 0.0;
};

/// Least-squares plane, or nothing when the rays lie on a line or there are fewer than 3.
inline std::optional<PlaneFit> Fit(const PlaneSums& s) {
  if (!(s.n >= 3) || !(s.w > 0)) return std::nullopt;
  const double mx = s.wx / s.w, my = s.wy / s.w, mq = s.wq / s.w;
  const double cxx = s.wxx - s.wx * mx, cxy = s.wxy - s.wx * my, cyy = s.wyy - s.wy * my;
  const double cxq = s.wqx - s.wx * mq, cyq = s.wqy - s.wy * mq, cqq = s.wqq - s.wq * mq;
  const double det = cxx * cyy - cxy * cxy;
  constexpr double kMinSpread = 1e-9;  // 1 - squared correlation of x and y: below, a line
  if (!(det > kMinSpread * cxx * cyy)) return std::nullopt;
  const double a = (cyy * cxq - cxy * cyq) / det, b = (cxx * cyq - cxy * cxq) / det;
  return PlaneFit{{a, b, mq - a * mx - b * my}, std::max(0.0, cqq - a * cxq - b * cyq)};
}

/// How many times the noise of `s` exceeds sigma(z) because its surface is seen at a slant;
/// >= 1.
inline double GrazingFactor(const PlaneSums& s, const InverseDepthPlane& p,
                            const DepthNoise& noise) {
  const double x = s.wx / s.w, y = s.wy / s.w, q = s.wq / s.w;
  return noise.GrazingFactor(1.0 / q, p.Cosine(x, y));
}

/// The same of a surface around centroid_c.
inline double GrazingFactor(const Eigen::Vector3d& centroid_c, const InverseDepthPlane& p,
                            const DepthNoise& noise) {
  const double z = centroid_c.z();
  return noise.GrazingFactor(z, p.Cosine(centroid_c.x() / z, centroid_c.y() / z));
}

/// Standard deviations of a fitted plane: of its distance at the centroid, metres, and of its
/// normal about the worse axis, radians. `scale` multiplies the noise; correlation is included.
struct PlaneSigmas {
  double offset_m = 0.0, angle_rad = 0.0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< that of (a, b, c), 1/m^2
};
PlaneSigmas Sigmas(const PlaneSums& sums, const InverseDepthPlane& plane,
                   const DepthNoise& noise, double scale);

}  // namespace slam
