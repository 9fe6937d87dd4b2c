#include "sim/shapes/steps.h"

#include <algorithm>
#include <optional>

#include "sim/scene/geometry.h"

namespace sim {
namespace {

constexpr double kMinUpward = 0.984807753012208;  // cos 10 degrees
constexpr double kRounding_m = 1e-9;  // a sheet over the top may be thinner than kTouch_m

using Polygon = std::vector<Eigen::Vector2d>;

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double Area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    twice += Cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return twice / 2;
}

/// Whether a part is more than objects that touch along an edge.
bool IsSurface(const Polygon& polygon) {
  double perimeter = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    perimeter += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  }
  return polygon.size() >= 3 && Area(polygon) > kTouch_m * perimeter / 2;
}

std::vector<Polygon> SeenFromAbove(const ScenePlane& plane) {
  std::vector<Polygon> pieces;
  for (const auto& piece : ConvexPieces(plane)) {
    pieces.emplace_back();
    for (const Eigen::Vector3d& vertex : piece) pieces.back().push_back(vertex.head<2>());
  }
  return pieces;
}

/// Sutherland and Hodgman: what both convex counter-clockwise polygons cover.
Polygon Clip(Polygon subject, const Polygon& window) {
  for (std::size_t i = 0; i < window.size() && !subject.empty(); ++i) {
    const Eigen::Vector2d& a = window[i];
    const Eigen::Vector2d edge = window[(i + 1) % window.size()] - a;
    Polygon kept;
    for (std::size_t j = 0; j < subject.size(); ++j) {
      const Eigen::Vector2d& p = subject[j];
      const Eigen::Vector2d& q = subject[(j + 1) % subject.size()];
      const double side_p = Cross(edge, p - a), side_q = Cross(edge, q - a);
      if (side_p >= 0) kept.push_back(p);
      if ((side_p < 0) != (side_q < 0))
        kept.push_back(p + side_p / (side_p - side_q) * (q - p));
    }
    subject = kept;
  }
  return subject;
}

/// Least distance along the top's normal down to `below` over the part that lies under it.
std::optional<double> StepOver(const ScenePlane& top, const ScenePlane& below) {
  std::vector<Eigen::Vector2d> corners;
  for (const Polygon& under : SeenFromAbove(below)) {
    for (const Polygon& window : SeenFromAbove(top)) {
      const Polygon shared = Clip(under, window);
      if (IsSurface(shared)) corners.insert(corners.end(), shared.begin(), shared.end());
    }
  }
  std::optional<double> least;
  for (const Eigen::Vector2d& at : corners) {
    const double z = -(below.d + below.n_w.head<2>().dot(at)) / below.n_w.z();
    const double step = top.n_w.dot(Eigen::Vector3d(at.x(), at.y(), z)) + top.d;
    if (step > kRounding_m) return std::nullopt;  // it stands over the top, not under it
    least = std::min(least.value_or(-step), -step);
  }
  if (least) least = std::max(*least, 0.0);
  return least;
}

}  // namespace

std::vector<TopStep> TopSteps(const Scene& scene, const std::vector<ScenePlane>& planes) {
  std::vector<ScenePlane> upward;
  for (const ScenePlane& plane : planes) {
    if (plane.n_w.z() > kMinUpward) upward.push_back(plane);
  }
  const auto role_of = [&](int id) {
    for (const Object& object : scene.objects) {
      if (object.id == id) return object.role;
    }
    return Role::kOther;
  };
  std::vector<TopStep> steps;
  for (const ScenePlane& top : upward) {
    if (role_of(top.object) != Role::kRegular) continue;
    std::optional<TopStep> nearest;
    for (const ScenePlane& below : upward) {
      if (below.object == top.object) continue;
      const std::optional<double> step = StepOver(top, below);
      if (!step || (nearest && *step * 1000 >= nearest->step_mm)) continue;
      nearest = TopStep{top.id, top.object, below.object, *step * 1000};
    }
    if (nearest) steps.push_back(*nearest);
  }
  return steps;
}

}  // namespace sim
