#pragma once

#include <Eigen/Core>
#include <limits>

namespace sim {

/// Lens distortion (Brown, as OpenCV writes it): of a ray (x, y, 1) with r^2 = x^2 + y^2
///   x' = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2)
///   y' = y (1 + k1 r^2 + k2 r^4 + k3 r^6) + p1 (r^2 + 2 y^2) + 2 p2 x y
struct Lens {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  /// Beyond this r the polynomial is not used: it goes on as a straight line from the axis,
  /// so that what lies far outside the image does not fold back into it. Set by WithLens.
  double reach = std::numeric_limits<double>::infinity();

  bool IsNone() const { return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0; }
  /// (x', y') of (x, y).
  Eigen::Vector2d Distort(const Eigen::Vector2d& ray) const;
  /// (x, y) of (x', y'), to 1e-13; NaN where there is none.
  Eigen::Vector2d Undistort(const Eigen::Vector2d& distorted) const;
};

}  // namespace sim
