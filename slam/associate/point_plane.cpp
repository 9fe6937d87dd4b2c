#include "slam/associate/point_plane.h"

#include <cmath>

#include "slam/geometry/pixel_projection.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

bool NearPlane(const FramePlane& plane, const Eigen::Vector3d& x_c, double max_m) {
  return !plane.bad && std::abs(SignedDistance(plane.pi_c, x_c)) < max_m;
}

/// The plane on whose pixels, or in whose boxes, the pixel lies; kNone when there is none.
int PlaneAt(const Frame& frame, const Eigen::Vector2i& pixel, const Eigen::Vector3d& x_c,
            double max_m) {
  const int label = frame.plane_labels.empty() ? 0 : frame.plane_labels(pixel.y(), pixel.x());
  if (label > 0 && label <= static_cast<int>(frame.planes.size())) {
    return NearPlane(frame.planes[static_cast<std::size_t>(label - 1)], x_c, max_m) ? label - 1
                                                                                    : kNone;
  }
  const Eigen::Vector2d u = pixel.cast<double>();
  // No plane has the pixel: a hole in one whose boxes hold it, the nearest.
  int best = kNone;
  double best_distance = max_m;
  for (const FramePlane& plane : frame.planes) {
    if (!plane.detection || plane.bad || !plane.box_px.Contains(u)) continue;
    const auto d = static_cast<std::size_t>(*plane.detection);
    if (d >= frame.detections.size() || !frame.detections[d].box_px.Contains(u)) continue;
    const double distance = std::abs(SignedDistance(plane.pi_c, x_c));
    if (distance < best_distance) {
      best_distance = distance;
      best = plane.index;
    }
  }
  return best;
}

}  // namespace

std::vector<PointPlaneMatch> AssociatePointsToPlanes(const Frame& frame, const Map& map,
                                                     const Camera& camera,
                                                     double max_distance_m) {
  std::vector<PointPlaneMatch> matches;
  for (const auto& [feature, id] : MatchedPoints(frame, map)) {
    const Eigen::Vector3d x_c = frame.T_cw * map.points[static_cast<std::size_t>(id)].p_w;
    const Eigen::Vector2i pixel =
        RecordedPixel(camera, camera.Backproject(frame.features[feature].u_px, 1.0));
    if (pixel.x() < 0) continue;
    const int plane = PlaneAt(frame, pixel, x_c, max_distance_m);
    if (plane != kNone) matches.push_back({static_cast<int>(feature), plane});
  }
  return matches;
}

}  // namespace slam
