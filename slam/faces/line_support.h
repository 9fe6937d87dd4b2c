#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace slam {

/// Image points with their x and y apart, so that several are looked at at a time.
struct PointColumns {
  std::vector<double> x, y;

  void Set(const std::vector<Eigen::Vector2d>& points);
  std::size_t size() const { return x.size(); }
};

/// Which points are near the line through p along v, unit.
struct LineStrip {
  double p_x, p_y, v_x, v_y;
  double max_distance;

  /// Strictly below the bound.
  bool Contains(double x, double y) const {
    const double across = v_x * (y - p_y) - v_y * (x - p_x);
    return (across < 0.0 ? -across : across) < max_distance;
  }
};

/// How many points a strip has; or, once they can no longer be more than `beat`, some number
/// up to that.
int CountUnlessFewer(const PointColumns& points, const LineStrip& strip, int beat);

/// The places of the points in a strip, ascending; what was in `near` is forgotten.
void FindNear(const PointColumns& points, const LineStrip& strip, std::vector<int>& near);

}  // namespace slam
