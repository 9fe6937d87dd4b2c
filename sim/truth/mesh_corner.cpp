#include "sim/truth/mesh_corner.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace sim {
namespace {

/// An outline that the scene declares may be off its mesh by as much, and still mean its corner.
constexpr double kSameCorner_m = 1e-4;

using Place = std::tuple<int, double, double, double>;

Place PlaceOf(int object, const Eigen::Vector3d& x_w) {
  return {object, x_w.x(), x_w.y(), x_w.z()};
}

/// The corner of the plane's triangles straight above or below a point of the plane.
Eigen::Vector3d Above(const std::vector<const Triangle*>& triangles, const ScenePlane& plane,
                      const Eigen::Vector3d& x_w) {
  Eigen::Vector3d nearest = x_w;
  double least = kSameCorner_m;
  for (const Triangle* triangle : triangles) {
    for (const Eigen::Vector3d& corner : triangle->corners_w) {
      const Eigen::Vector3d way = corner - x_w;
      const double beside = (way - plane.n_w.dot(way) * plane.n_w).norm();
      if (!(beside < least)) continue;
      least = beside;
      nearest = corner;
    }
  }
  return nearest;
}

}  // namespace

std::vector<std::vector<MeshCorner>> MeshCorners(const SceneMesh& mesh) {
  const auto is_box = [&](int id) {
    return mesh.planes.at(static_cast<std::size_t>(id) - 1).pieces_w.empty();
  };
  std::map<int, std::vector<const Triangle*>> triangles_of;
  std::map<Place, std::set<int>> meet_in;
  for (const Triangle& triangle : mesh.triangles) {
    if (triangle.plane == 0 || is_box(triangle.plane)) continue;
    triangles_of[triangle.plane].push_back(&triangle);
    for (const Eigen::Vector3d& x_w : triangle.corners_w) {
      meet_in[PlaceOf(triangle.object, x_w)].insert(triangle.plane);
    }
  }
  std::vector<std::vector<MeshCorner>> corners;
  for (const ScenePlane& plane : mesh.planes) {
    corners.emplace_back();
    for (const Eigen::Vector3d& x_w : plane.vertices_w) {
      MeshCorner corner{x_w, {}};
      if (!is_box(plane.id)) {
        corner.x_w = Above(triangles_of[plane.id], plane, x_w);
        std::set<int> planes = meet_in[PlaceOf(plane.object, corner.x_w)];
        planes.insert(plane.id);
        corner.planes.assign(planes.begin(), planes.end());
      }
      corners.back().push_back(corner);
    }
  }
  return corners;
}

}  // namespace sim
