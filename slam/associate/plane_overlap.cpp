#include "slam/associate/plane_overlap.h"

#include <algorithm>
#include <limits>

#include "slam/associate/occlusion.h"
#include "slam/geometry/pixel_projection.h"

namespace slam {
namespace {

/// A frame plane's area, in points of the cloud.
double PointsOn(const PlaneView& view, const FramePlane& frame_plane) {
  return view.cell_m2 > 0 ? frame_plane.area_m2 / view.cell_m2
                          : std::numeric_limits<double>::max();
}

/// The points that land on a frame plane, of as many as a footprint has.
double ShareLanded(const PlaneView& view, const FramePlane& frame_plane, double footprint) {
  const auto index = static_cast<std::size_t>(frame_plane.index);
  if (index >= view.landed.size()) return 0.0;
  constexpr double kMinPoints = 3.0;  // a single point of a coarse cloud is no overlap
  return std::min(1.0, view.landed[index] / std::max(footprint, kMinPoints));
}

}  // namespace

PlaneView ViewMapPlane(const MapPlane& map_plane, const Frame& frame, const Pose& T_cw,
                       const Camera& camera) {
  PlaneView view;
  view.landed.assign(frame.planes.size(), 0);
  if (map_plane.points_w.empty()) return view;
  view.cell_m2 = map_plane.area_m2 / static_cast<double>(map_plane.points_w.size());
  const bool has_depth =
      frame.depth_m.rows == camera.height && frame.depth_m.cols == camera.width;
  const bool has_labels =
      frame.plane_labels.rows == camera.height && frame.plane_labels.cols == camera.width;
  // Points in the picture that nothing nearer hides are expected; some land on a segment.
  for (const Eigen::Vector3d& p_w : map_plane.points_w) {
    const Eigen::Vector3d x_c = T_cw * p_w;
    const Eigen::Vector2i u = RecordedPixel(camera, x_c);
    if (u.x() < 0) continue;
    const double depth = has_depth ? static_cast<double>(frame.depth_m(u.y(), u.x())) : x_c.z();
    if (!(depth > 0) || IsHidden(depth, x_c.z())) continue;
    ++view.expected;
    const int label = has_labels ? frame.plane_labels(u.y(), u.x()) : 0;
    if (label > 0 && label <= static_cast<int>(frame.planes.size())) {
      ++view.landed[static_cast<std::size_t>(label - 1)];
    }
  }
  return view;
}

double Overlap(const PlaneView& view, const FramePlane& frame_plane) {
  const double smaller =
      std::min(static_cast<double>(view.expected), PointsOn(view, frame_plane));
  return ShareLanded(view, frame_plane, smaller);
}

double Covered(const PlaneView& view, const FramePlane& frame_plane) {
  return ShareLanded(view, frame_plane, PointsOn(view, frame_plane));
}

}  // namespace slam
