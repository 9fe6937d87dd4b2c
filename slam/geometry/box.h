#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace slam {

/// Axis-aligned rectangle in pixels, pixel centres at integers. Empty when max < min.
struct Box {
  Eigen::Vector2d min = Eigen::Vector2d::Zero();   ///< (u, v) left, top
  Eigen::Vector2d max = -Eigen::Vector2d::Ones();  ///< (u, v) right, bottom

  bool empty() const { return !(max.x() >= min.x() && max.y() >= min.y()); }
  double width() const { return empty() ? 0.0 : max.x() - min.x(); }
  double height() const { return empty() ? 0.0 : max.y() - min.y(); }
  double area() const { return width() * height(); }
  Eigen::Vector2d center() const { return 0.5 * (min + max); }
  bool Contains(const Eigen::Vector2d& u_px, double margin_px = 0.0) const {
    return u_px.x() >= min.x() - margin_px && u_px.x() <= max.x() + margin_px &&
           u_px.y() >= min.y() - margin_px && u_px.y() <= max.y() + margin_px;
  }
  void Include(const Eigen::Vector2d& u_px) {
    if (empty()) {
      min = max = u_px;
    } else {
      min = min.cwiseMin(u_px);
      max = max.cwiseMax(u_px);
    }
  }
};

inline Box Intersection(const Box& a, const Box& b) {
  if (a.empty() || b.empty()) return {};
  return {a.min.cwiseMax(b.min), a.max.cwiseMin(b.max)};
}

/// Intersection over union of the areas, in [0, 1]; 0 when both areas are 0.
inline double Iou(const Box& a, const Box& b) {
  const double shared = Intersection(a, b).area();
  const double both = a.area() + b.area() - shared;
  return both > 0 ? shared / both : 0.0;
}

}  // namespace slam
