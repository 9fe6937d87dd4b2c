#include "slam/features/point_projection.h"

#include "slam/base/chi_square.h"
#include "slam/geometry/pixel_projection.h"

namespace slam {

std::optional<ExpectedView> ExpectView(const MapPoint& point, const Pose& T_cw,
                                       const Camera& camera, const FeatureScale& scale) {
  constexpr double kRangeMargin = 1.2;    // one octave on the range of distances; ORB-SLAM2
  constexpr double kMinViewCosine = 0.5;  // 60 degrees: beyond, a corner looks otherwise
  const Eigen::Vector3d p_c = T_cw * point.p_w;
  if (RecordedPixel(camera, p_c).x() < 0) return std::nullopt;
  // From too near or too far the point shows in an octave that the pyramid does not have.
  const double distance = p_c.norm();
  if (!(distance * kRangeMargin >= point.min_distance_m &&
        distance <= kRangeMargin * point.max_distance_m)) {
    return std::nullopt;
  }
  const double cosine = (T_cw.R * point.view_w).dot(p_c) / distance;
  if (!(cosine >= kMinViewCosine)) return std::nullopt;
  return ExpectedView{camera.Project(p_c), scale.PredictOctave(distance, point.max_distance_m),
                      cosine};
}

PointQuery QueryOf(const MapPoint& point, const Pose& T_cw, const Camera& camera,
                   const FeatureScale& scale, double radius_factor,
                   const PointProjectionConfig& config) {
  PointQuery query;
  const auto view = ExpectView(point, T_cw, camera, scale);
  if (!view) return query;
  const double radius = view->cosine >= config.straight_view_cosine ? config.straight_radius_px
                                                                    : config.radius_px;
  query.point = point.id;
  query.u_px = view->u_px;
  query.radius_px = radius * radius_factor * scale.Scale(view->octave);
  query.min_octave = view->octave - 1;
  query.max_octave = view->octave + 1;
  query.descriptor = point.descriptor;
  return query;
}

bool AgreesWith(const PointFeature& feature, const Eigen::Vector3d& p_c, const Camera& camera,
                const FeatureScale& scale) {
  // Reprojection error, and that of the disparity where the feature has a depth.
  double error2_px2 = (camera.Project(p_c) - feature.u_px).squaredNorm();
  const bool has_depth = feature.depth_m > 0;
  if (has_depth) {
    const double disparity = scale.Disparity_px(p_c.z()) - scale.Disparity_px(feature.depth_m);
    error2_px2 += disparity * disparity;
  }
  const double max_chi2 = has_depth ? kChi2Of3At95 : kChi2Of2At95;
  return error2_px2 <= max_chi2 * scale.Variance(feature.octave);
}

}  // namespace slam
