#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/shapes/planes.h"

namespace sim {

/// One triangle of the scene, world frame, counter-clockwise seen from outside.
struct Triangle {
  std::array<Eigen::Vector3d, 3> corners_w;
  std::array<Eigen::Vector2d, 3> uv_m;  ///< position on the face, metres (toys: a cube map)
  std::array<Eigen::Vector3d, 3> normals_w;  ///< shading normals; the plane's own on boxes
  int object = 0;                            ///< Object::id
  int plane = 0;                             ///< ScenePlane::id, 0 on a toy
  int material = 0;                          ///< index into SceneMesh::materials
};

struct SceneMesh {
  std::vector<Triangle> triangles;
  std::vector<Material> materials;
  std::vector<ScenePlane> planes;  ///< by id - 1
};

/// Planes and triangles of every object: two triangles a box face, a few hundred a toy. What
/// moves stands at the first point of its way, and has no planes.
SceneMesh BuildMesh(const Scene& scene);

}  // namespace sim
