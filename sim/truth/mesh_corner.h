#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/shapes/mesh.h"

namespace sim {

/// Where a corner of a plane lies on the surface that rays meet. Planes of meshes are fitted, and
/// their corners are projected onto them, so these lie beside those of the mesh, behind its
/// triangles too, by as much as the mesh is uneven.
struct MeshCorner {
  Eigen::Vector3d x_w;  ///< the mesh's own corner; the plane's where the mesh has none there
  std::vector<int>
      planes;  ///< ids of those that meet in it, rising; empty: a box, which is exact
};

/// Of all planes, by id - 1, in the order of ScenePlane::vertices_w.
std::vector<std::vector<MeshCorner>> MeshCorners(const SceneMesh& mesh);

}  // namespace sim
