#include "slam/associate/plane_samples.h"

#include "slam/associate/occlusion.h"
#include "slam/geometry/pixel_projection.h"

namespace slam {

std::vector<std::vector<Eigen::Vector3d>> FeaturesOnPlanes(const Frame& frame, const Pose& T_cw,
                                                           const Camera& camera) {
  std::vector<std::vector<Eigen::Vector3d>> on_plane(frame.planes.size());
  if (frame.plane_labels.empty()) return on_plane;
  const Pose T_wc = Inverse(T_cw);
  for (const PointFeature& feature : frame.features) {
    if (!(feature.depth_m > 0)) continue;
    const Eigen::Vector3d x_c = camera.Backproject(feature.u_px, feature.depth_m);
    const Eigen::Vector2i u = RecordedPixel(camera, x_c);
    if (u.x() < 0) continue;
    const auto label = static_cast<std::size_t>(frame.plane_labels(u.y(), u.x()));
    if (label > 0 && label <= on_plane.size()) on_plane[label - 1].push_back(T_wc * x_c);
  }
  return on_plane;
}

std::vector<Eigen::Vector3d> VisibleMapPoints(const MapPlane& map_plane, const Map& map,
                                              const Frame& frame, const Pose& T_cw,
                                              const Camera& camera) {
  std::vector<Eigen::Vector3d> visible;
  for (const int id : map_plane.map_points) {
    if (id < 0 || id >= static_cast<int>(map.points.size())) continue;
    const MapPoint& point = map.points[static_cast<std::size_t>(id)];
    if (point.culled) continue;
    const Eigen::Vector3d x_c = T_cw * point.p_w;
    const Eigen::Vector2i u = RecordedPixel(camera, x_c);
    if (u.x() < 0) continue;
    const double depth =
        frame.depth_m.empty() ? x_c.z() : static_cast<double>(frame.depth_m(u.y(), u.x()));
    if (!(depth > 0) || IsHidden(depth, x_c.z())) continue;  // as M_c, which needs depth
    visible.push_back(point.p_w);
  }
  return visible;
}

}  // namespace slam
