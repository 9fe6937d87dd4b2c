#include "slam/faces/line_support.h"

#include "slam/base/lane_math.h"

namespace slam {
namespace {

constexpr int kFour = 4;
constexpr int kAtOnce = 32;  // points between two looks at what is left

using FourMarks = decltype(DoubleLanes{} < DoubleLanes{});

/// -1 for each of four points that is in the strip.
SLAM_INLINE FourMarks Inside(const double* x, const double* y, const LineStrip& strip) {
  const DoubleLanes across =
      strip.v_x * (Lanes(y) - strip.p_y) - strip.v_y * (Lanes(x) - strip.p_x);
  const DoubleLanes size = across < 0.0 ? -across : across;
  return size < strip.max_distance;
}

}  // namespace

void PointColumns::Set(const std::vector<Eigen::Vector2d>& points) {
  x.clear(), y.clear();
  for (const Eigen::Vector2d& u : points) x.push_back(u.x()), y.push_back(u.y());
}

SLAM_LANES int CountUnlessFewer(const PointColumns& points, const LineStrip& strip, int beat) {
  const LineStrip in_register = strip;
  const double *x = points.x.data(), *y = points.y.data();
  const int n = static_cast<int>(points.size());
  int inside = 0, k = 0;
  while (n - k >= kAtOnce) {
    if (inside + (n - k) <= beat) return inside;
    FourMarks marks{};
    for (int last = k + kAtOnce; k < last; k += kFour)
      marks += Inside(x + k, y + k, in_register);
    inside -= static_cast<int>(marks[0] + marks[1] + marks[2] + marks[3]);
  }
  for (; k < n; ++k) inside += in_register.Contains(x[k], y[k]) ? 1 : 0;
  return inside;
}

void FindNear(const PointColumns& points, const LineStrip& strip, std::vector<int>& near) {
  near.resize(points.size());
  std::size_t found = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    near[found] = static_cast<int>(k);  // no branch: it could not be foreseen
    found += strip.Contains(points.x[k], points.y[k]) ? 1 : 0;
  }
  near.resize(found);
}

}  // namespace slam
