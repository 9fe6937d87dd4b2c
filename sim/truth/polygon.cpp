#include "sim/truth/polygon.h"

#include <algorithm>
#include <limits>

#include "sim/truth/silhouette.h"

namespace sim {
namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::Vector2d OnSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                          const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double squared = along.squaredNorm();
  if (!(squared > 0)) return a;
  return a + std::clamp(along.dot(p - a) / squared, 0.0, 1.0) * along;
}

void TryCorners(const Polygon& corners, const Polygon& other, bool corners_are_a,
                ClosestPoints& best) {
  for (const Eigen::Vector2d& p : corners) {
    for (std::size_t i = 0; i < other.size(); ++i) {
      const Eigen::Vector2d q = OnSegment(p, other[i], other[(i + 1) % other.size()]);
      const double distance = (p - q).norm();
      if (!(distance < best.distance)) continue;
      best = corners_are_a ? ClosestPoints{p, q, distance} : ClosestPoints{q, p, distance};
    }
  }
}

}  // namespace

Polygon CutAt(const Polygon& polygon, const Eigen::Vector2d& normal, double offset) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double dp = normal.dot(p) - offset, dq = normal.dot(q) - offset;
    if (dp <= 0) kept.push_back(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
      kept.push_back(p + dp / (dp - dq) * (q - p));
    }
  }
  return kept;
}

double SignedArea(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    twice += Cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return twice / 2;
}

Polygon Overlap(const Polygon& a, const Polygon& b) {
  Polygon shared = a;
  // Sutherland and Hodgman: every edge of b cuts off what lies outside of it.
  const double turn = SignedArea(b) < 0 ? -1.0 : 1.0;
  for (std::size_t i = 0; i < b.size() && !shared.empty(); ++i) {
    const Eigen::Vector2d edge = b[(i + 1) % b.size()] - b[i];
    const Eigen::Vector2d outward = turn * Eigen::Vector2d(edge.y(), -edge.x());
    shared = CutAt(shared, outward, outward.dot(b[i]));
  }
  return shared;
}

ClosestPoints Closest(const Polygon& a, const Polygon& b) {
  const Polygon shared = Overlap(a, b);
  if (!shared.empty()) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& p : shared) mean += p / static_cast<double>(shared.size());
    return {mean, mean, 0};
  }
  // Of convex polygons apart, a corner of one of them is among the closest points.
  ClosestPoints best{{}, {}, std::numeric_limits<double>::infinity()};
  TryCorners(a, b, true, best);
  TryCorners(b, a, false, best);
  return best;
}

Polygon ProjectedFace(const ScenePlane& plane, const Pose& T_wc, const Camera& camera) {
  const Pose T_cw = Inverse(T_wc);
  // What is too near is cut off in space, where edges are straight; the rest in the image.
  Polygon polygon;
  for (std::size_t i = 0; i < plane.vertices_w.size(); ++i) {
    const Eigen::Vector3d a = T_cw * plane.vertices_w[i];
    const Eigen::Vector3d b = T_cw * plane.vertices_w[(i + 1) % plane.vertices_w.size()];
    if (a.z() > kSilhouetteNear_m) polygon.push_back(camera.Project(a));
    if ((a.z() > kSilhouetteNear_m) != (b.z() > kSilhouetteNear_m)) {
      const double t = (kSilhouetteNear_m - a.z()) / (b.z() - a.z());
      polygon.push_back(camera.Project(a + t * (b - a)));
    }
  }
  polygon = CutAt(polygon, {1, 0}, camera.width - 0.5);
  polygon = CutAt(polygon, {-1, 0}, 0.5);
  polygon = CutAt(polygon, {0, 1}, camera.height - 0.5);
  polygon = CutAt(polygon, {0, -1}, 0.5);
  return polygon;
}

}  // namespace sim
