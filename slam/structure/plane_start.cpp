#include "slam/structure/plane_start.h"

#include <cmath>

#include "slam/structure/supposed_planes.h"

namespace slam {
namespace {

constexpr double kMaxCosine = 0.9;  // 26 degrees

bool SomeTwoStandApart(const std::vector<Eigen::Vector3d>& normals) {
  for (const Eigen::Vector3d& one : normals) {
    for (const Eigen::Vector3d& other : normals) {
      if (std::abs(one.dot(other)) < kMaxCosine) return true;
    }
  }
  return false;
}

}  // namespace

bool PlanesCanStart(const std::vector<FramePlane>& planes, double image_px,
                    const StructureConfig& config) {
  std::vector<Eigen::Vector3d> faces, edges;
  for (const FramePlane& plane : planes) {
    if (plane.bad || !IsProofAlone(plane, image_px)) continue;
    faces.push_back(plane.pi_c.n);
    if (!config.edges_alone) continue;
    for (const MeasuredPlane& edge : SupposePlanes(plane, config.supposed))
      edges.push_back(edge.pi_c.n);
  }
  return SomeTwoStandApart(faces) || SomeTwoStandApart(edges);
}

}  // namespace slam
