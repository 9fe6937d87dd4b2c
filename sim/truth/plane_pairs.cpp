#include "sim/truth/plane_pairs.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

#include "sim/truth/polygon.h"

namespace sim {
namespace {

using Eigen::Vector3d;

/// A frame in plane a: its first corner, two axes and its normal.
struct PlaneFrame {
  explicit PlaneFrame(const ScenePlane& a)
      : origin_w(a.vertices_w[0]),
        u_w((a.vertices_w[1] - a.vertices_w[0]).normalized()),
        v_w(a.n_w.cross(u_w)) {}
  Eigen::Vector2d Flat(const Vector3d& x_w) const {
    return {u_w.dot(x_w - origin_w), v_w.dot(x_w - origin_w)};
  }
  Vector3d origin_w, u_w, v_w;
};

std::vector<Polygon> FlatFace(const PlaneFrame& frame, const ScenePlane& plane) {
  std::vector<Polygon> pieces;
  for (const auto& piece : ConvexPieces(plane)) {
    pieces.emplace_back();
    for (const Vector3d& x_w : piece) pieces.back().push_back(frame.Flat(x_w));
  }
  return pieces;
}

/// Closest points of all pieces; where several overlap, of the first that do.
ClosestPoints ClosestOf(const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
  ClosestPoints best{{}, {}, std::numeric_limits<double>::infinity()};
  for (const Polygon& one : a) {
    for (const Polygon& other : b) {
      const ClosestPoints closest = Closest(one, other);
      if (closest.distance < best.distance) best = closest;
      if (best.distance == 0) return best;
    }
  }
  return best;
}

std::optional<PlanePair> Compare(const ScenePlane& a, const ScenePlane& b) {
  const double sine = a.n_w.cross(b.n_w).norm(), cosine = a.n_w.dot(b.n_w);
  const double angle_deg = std::atan2(sine, cosine) * 180 / std::numbers::pi;
  if (!(angle_deg <= kPairMaxAngle_deg)) return std::nullopt;
  // Both faces are laid flat into a's plane, where their gap is measured.
  const PlaneFrame frame(a);
  const ClosestPoints closest = ClosestOf(FlatFace(frame, a), FlatFace(frame, b));
  if (!(closest.distance <= kPairMaxGap_m)) return std::nullopt;
  // b's height over a, above the point of b that was found.
  const Vector3d foot_w =
      frame.origin_w + closest.on_b.x() * frame.u_w + closest.on_b.y() * frame.v_w;
  const double step_m = -(b.n_w.dot(foot_w) + b.d) / b.n_w.dot(a.n_w);
  return PlanePair{a.id,          b.id,
                   angle_deg,     closest.distance * 1000,
                   step_m * 1000, std::abs(step_m) / kPairSigma_m};
}

}  // namespace

std::vector<PlanePair> PlanePairs(const Scene& scene, const std::vector<ScenePlane>& planes) {
  std::set<int> scored;
  for (const Object& object : scene.objects) {
    if (object.role == Role::kStructure || object.role == Role::kRegular) {
      scored.insert(object.id);
    }
  }
  std::vector<PlanePair> pairs;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!scored.contains(planes[i].object)) continue;
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      if (!scored.contains(planes[j].object)) continue;
      if (const auto pair = Compare(planes[i], planes[j])) pairs.push_back(*pair);
    }
  }
  return pairs;
}

}  // namespace sim
