#include "eval/planes/polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace eval {
namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Twice the area left of o -> a -> b.
double Turn(const Eigen::Vector2d& o, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return Cross(a - o, b - o);
}

/// The part of `subject` on the left of the line a -> b.
Polygon2 ClipLeft(const Polygon2& subject, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  Polygon2 kept;
  for (std::size_t i = 0; i < subject.size(); ++i) {
    const Eigen::Vector2d& p = subject[i];
    const Eigen::Vector2d& q = subject[(i + 1) % subject.size()];
    const double side_p = Turn(a, b, p), side_q = Turn(a, b, q);
    if (side_p >= 0.0) kept.push_back(p);
    if ((side_p > 0.0 && side_q < 0.0) || (side_p < 0.0 && side_q > 0.0)) {
      kept.push_back(p + (side_p / (side_p - side_q)) * (q - p));
    }
  }
  return kept;
}

}  // namespace

PlaneChart ChartOf(const Plane& pi, const Eigen::Vector3d& near) {
  const Eigen::Vector3d u = pi.n.unitOrthogonal();
  return {near - SignedDistance(pi, near) * pi.n, u, pi.n.cross(u)};
}

Polygon2 Project(const PlaneChart& chart, const std::vector<Eigen::Vector3d>& points) {
  Polygon2 projected;
  projected.reserve(points.size());
  for (const Eigen::Vector3d& p : points) projected.push_back(chart(p));
  return projected;
}

Polygon2 ConvexHull(Polygon2 points) {
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  const auto chain = [](const auto first, const auto last) {
    Polygon2 hull;
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= 2 && Turn(hull[hull.size() - 2], hull.back(), *p) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();
    return hull;
  };
  Polygon2 hull = chain(points.begin(), points.end());
  const Polygon2 upper = chain(points.rbegin(), points.rend());
  hull.insert(hull.end(), upper.begin(), upper.end());
  return hull;
}

bool GoesRoundFromAbove(const std::vector<Eigen::Vector3d>& loop,
                        const Eigen::Vector3d& point) {
  std::vector<cv::Point2f> about_point;  // so that single precision is enough
  for (const Eigen::Vector3d& corner : loop) {
    about_point.emplace_back(static_cast<float>(corner.x() - point.x()),
                             static_cast<float>(corner.y() - point.y()));
  }
  return cv::pointPolygonTest(about_point, {0.0f, 0.0f}, false) > 0;
}

double Area(const Polygon2& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    twice += Cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  }
  return 0.5 * std::abs(twice);
}

double IntersectionArea(const Polygon2& a, const Polygon2& b) {
  if (a.size() < 3 || b.size() < 3) return 0.0;
  Polygon2 common = a;
  for (std::size_t i = 0; i < b.size() && !common.empty(); ++i) {
    common = ClipLeft(common, b[i], b[(i + 1) % b.size()]);
  }
  return Area(common);
}

double Distance(const Eigen::Vector2d& point, const Polygon2& polygon) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = polygon.size() >= 3;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d edge = polygon[(i + 1) % polygon.size()] - a;
    if (Cross(edge, point - a) < 0.0) inside = false;
    const double length2 = edge.squaredNorm();
    const double along =
        length2 > 0.0 ? std::clamp(edge.dot(point - a) / length2, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (point - a - along * edge).norm());
  }
  return inside ? 0.0 : nearest;
}

double HausdorffDistance(const Polygon2& a, const Polygon2& b) {
  // The distance from a convex set has its largest value over another one at a corner of that.
  double farthest = 0.0;
  for (const Eigen::Vector2d& corner : a) farthest = std::max(farthest, Distance(corner, b));
  for (const Eigen::Vector2d& corner : b) farthest = std::max(farthest, Distance(corner, a));
  return farthest;
}

}  // namespace eval
