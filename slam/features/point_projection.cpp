#include "slam/features/point_projection.h"

namespace slam {

PointQuery QueryOf(const MapPoint& point, const Pose& T_cw, const Camera& camera,
                   double radius_factor, const PointProjectionConfig& config) {
  PointQuery query;
  const Eigen::Vector3d p_c = T_cw * point.p_w;
  if (!(p_c.z() > 0)) return query;
  const double distance = p_c.norm();
  if (!(distance * config.range_margin >= point.min_distance_m &&
        distance <= config.range_margin * point.max_distance_m)) {
    return query;
  }
  const Eigen::Vector2d u_px = camera.Project(p_c);
  if (!camera.ImageBox().Contains(u_px)) return query;
  const double cosine = (T_cw.R * point.view_w).dot(p_c) / distance;
  if (!(cosine >= config.min_view_cosine)) return query;

  const int octave = config.scales.PredictOctave(distance, point.max_distance_m);
  const double radius =
      cosine >= config.straight_view_cosine ? config.straight_radius_px : config.radius_px;
  query.point = point.id;
  query.u_px = u_px;
  query.right_u_px = u_px.x() - config.bf_px_m / p_c.z();
  query.radius_px = radius * radius_factor * config.scales.Scale(octave);
  query.min_octave = octave - 1;
  query.max_octave = octave + 1;
  query.descriptor = point.descriptor;
  return query;
}

}  // namespace slam
