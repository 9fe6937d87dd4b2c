#include "sim/shapes/round.h"

#include <stdexcept>

#include "sim/base/angle.h"

namespace sim {
namespace {

constexpr int kSides = 48;

/// From the axis round the outside and back to the axis: (radius, height) as parts of the half
/// width and the height.
using Profile = std::vector<Eigen::Vector2d>;

const Profile& ProfileOf(ShapeKind kind) {
  static const Profile cylinder{{0, -.5}, {1, -.5}, {1, .5}, {0, .5}};
  static const Profile mug{{0, -.5}, {1, -.5}, {1, .5}, {.91, .5}, {.91, -.44}, {0, -.44}};
  static const Profile bottle{{0, -.5},   {1, -.5},   {1, .12},   {.86, .22}, {.42, .33},
                              {.34, .37}, {.34, .46}, {.38, .46}, {.38, .5},  {0, .5}};
  static const Profile bowl{{0, -.5},  {.45, -.5}, {.52, -.43}, {.76, -.2},  {.92, .1}, {1, .5},
                            {.95, .5}, {.86, .12}, {.7, -.16},  {.46, -.38}, {0, -.4}};
  switch (kind) {
    case ShapeKind::kCylinder:
      return cylinder;
    case ShapeKind::kMug:
      return mug;
    case ShapeKind::kBottle:
      return bottle;
    case ShapeKind::kBowl:
      return bowl;
    case ShapeKind::kBox:
    case ShapeKind::kToy:
    case ShapeKind::kBush:
    case ShapeKind::kMesh:
    case ShapeKind::kPerson:
    case ShapeKind::kHand:
      break;
  }
  throw std::invalid_argument("not a body of revolution");
}

}  // namespace

ClosedSurface RoundSurface(ShapeKind kind, const Eigen::Vector3d& size) {
  const Profile& profile = ProfileOf(kind);
  ClosedSurface body;
  std::vector<int> first;  // vertex of each ring at angle 0; a ring on the axis has one vertex
  for (const Eigen::Vector2d& at : profile) {
    first.push_back(static_cast<int>(body.vertices_o.size()));
    const int corners = at.x() > 0 ? kSides : 1;
    for (int i = 0; i < corners; ++i) {
      const SinCos turn = SinCosDeg(360.0 / kSides * i);
      body.vertices_o.emplace_back(at.x() * turn.cos * size.x() / 2,
                                   at.x() * turn.sin * size.y() / 2, at.y() * size.z());
    }
  }
  const auto vertex = [&](std::size_t ring, int i) {
    return profile[ring].x() > 0 ? first[ring] + i % kSides : first[ring];
  };
  for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (int i = 0; i < kSides; ++i) {
      const int a = vertex(ring, i), b = vertex(ring, i + 1);
      const int c = vertex(ring + 1, i + 1), d = vertex(ring + 1, i);
      if (a != b) body.triangles.push_back({a, b, c});
      if (c != d) body.triangles.push_back({a, c, d});
    }
  }
  return body;
}

}  // namespace sim
