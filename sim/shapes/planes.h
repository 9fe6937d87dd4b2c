#pragma once

#include <vector>

#include "sim/scene/scene.h"

namespace sim {

/// A truth plane: one face of a box, or a flat part of a mesh. n . x + d = 0, n out of the
/// object, world frame.
struct ScenePlane {
  int id = 0;                ///< from 1, in the order of objects and faces
  int object = 0;            ///< Object::id
  Face face = Face::kPlusZ;  ///< which face of a box
  Eigen::Vector3d n_w = Eigen::Vector3d::UnitZ();
  double d = 0;
  double area_m2 = 0;
  /// Counter-clockwise seen from the front. Four of a box; those of a mesh may turn either way.
  std::vector<Eigen::Vector3d> vertices_w;
  std::vector<std::vector<Eigen::Vector3d>> holes_w;   ///< only in a mesh; clockwise
  std::vector<std::vector<Eigen::Vector3d>> pieces_w;  ///< only in a mesh: its triangles
};

/// All truth planes, by object; those of a box in the order of its faces.
std::vector<ScenePlane> ScenePlanes(const Scene& scene);

/// Convex polygons that make up a plane: itself, or the triangles of a mesh.
std::vector<std::vector<Eigen::Vector3d>> ConvexPieces(const ScenePlane& plane);

}  // namespace sim
