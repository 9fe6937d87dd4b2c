#include "slam/mapping/expected_planes.h"

#include <algorithm>

#include "slam/mapping/plane_face.h"

namespace slam {
namespace {

constexpr double kNearest_m = 0.1;  // a corner nearer to the camera is not projected
// Corners of a known face are that exact; a hull is inside of the surface's outline by up to a
// voxel, on average half of one.
constexpr double kCorner_m = 0.004;

/// Empty if a corner is not in front of the camera or the whole is beside the image.
std::vector<Eigen::Vector2d> ProjectOutline(const std::vector<Eigen::Vector3d>& outline_w,
                                            const Pose& T_cw, const Camera& camera) {
  std::vector<Eigen::Vector2d> outline_px;
  Box bounds_px;
  for (const Eigen::Vector3d& x_w : outline_w) {
    const Eigen::Vector3d x_c = T_cw * x_w;
    if (!(x_c.z() > kNearest_m)) return {};
    outline_px.push_back(camera.distorted() ? camera.ProjectDistorted(x_c)
                                            : camera.Project(x_c));
    bounds_px.Include(outline_px.back());
  }
  const bool seen = !bounds_px.empty() && Intersection(bounds_px, camera.ImageBox()).area() > 0;
  return seen ? outline_px : std::vector<Eigen::Vector2d>{};
}

}  // namespace

std::vector<ExpectedPlane> ExpectPlanes(const Map& map, const Pose& T_cw, const Camera& camera,
                                        const PlaneMapConfig& config) {
  std::vector<ExpectedPlane> expected;
  for (const MapPlane& plane : map.planes) {
    if (plane.status != LandmarkStatus::kLandmark ||
        plane.observations < config.min_fused_observations)
      continue;
    ExpectedPlane at;
    at.pi_c = Transform(T_cw, plane.pi_w);
    const double depth_m = (T_cw * plane.centroid_w).z();
    if (!(at.pi_c.d > 0.0) || !(depth_m > kNearest_m)) continue;
    const bool knows_face = KnowsItsFace(plane, config);
    at.outline_px = ProjectOutline(knows_face ? plane.vertices_w : plane.hull_w, T_cw, camera);
    at.margin_px = (knows_face ? kCorner_m : 0.5 * config.voxel_m) *
                       std::max(camera.fx, camera.fy) / depth_m +
                   1.0;
    expected.push_back(std::move(at));
  }
  return expected;
}

}  // namespace slam
