#include "slam/associate/projected_box.h"

#include "slam/geometry/pixel_projection.h"
#include "slam/model/frame_plane.h"

namespace slam {
namespace {

/// Corners outside the picture count, as far as the lens model can be trusted.
bool IncludeCorners(const std::vector<Eigen::Vector3d>& corners_w, const Pose& T_cw,
                    const Camera& camera, Box& box) {
  constexpr double kMaxOutside = 0.5;  // image sizes
  const Eigen::Vector2d size(camera.width, camera.height);
  for (const Eigen::Vector3d& p_w : corners_w) {
    const Eigen::Vector3d x_c = T_cw * p_w;
    if (!(x_c.z() > kMinVisibleDepth_m)) return false;
    const Eigen::Vector2d ideal = camera.Project(x_c);
    if (!((ideal.array() > -kMaxOutside * size.array()).all() &&
          (ideal.array() < (1 + kMaxOutside) * size.array()).all())) {
      return false;
    }
    box.Include(camera.ProjectDistorted(x_c));
  }
  return !corners_w.empty();
}

}  // namespace

Box ProjectedBox(const MapPlane& map_plane, const Pose& T_cw, const Camera& camera) {
  const bool has_corners = map_plane.vertices_w.size() == kFaceCorners;
  Box box;
  if (!IncludeCorners(has_corners ? map_plane.vertices_w : map_plane.hull_w, T_cw, camera,
                      box)) {
    box = {};
    for (const Eigen::Vector3d& p_w : map_plane.points_w) {
      const Eigen::Vector2i u = RecordedPixel(camera, T_cw * p_w);
      if (u.x() >= 0) box.Include(u.cast<double>());
    }
  }
  return Intersection(box, camera.ImageBox());
}

}  // namespace slam
