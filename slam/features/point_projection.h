#pragma once

#include <optional>

#include "slam/base/field_visitor.h"
#include "slam/features/match_features.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map_point.h"

namespace slam {

/// Where and how a map point is looked for.
struct PointProjectionConfig {
  double straight_view_cosine = 0.998;  ///< from here on the smaller radius
  double straight_radius_px = 2.5;      ///< search radius at octave 0, seen as before
  double radius_px = 4.0;               ///< ... and seen from another side
};

inline void VisitFields(PointProjectionConfig& c, FieldVisitor& v) {
  v.Number("straight_view_cosine", c.straight_view_cosine, "[-1, 1]",
           "from here on the smaller radius");
  v.Number("straight_radius_px", c.straight_radius_px, "(0, inf)",
           "search radius, seen as before");
  v.Number("radius_px", c.radius_px, "(0, inf)", "search radius, from another side");
}

/// How a map point should look from a pose.
struct ExpectedView {
  Eigen::Vector2d u_px;  ///< ideal image
  double depth_m = 0.0;
  int octave = 0;
  double cosine = 1.0;  ///< between its ray and the mean view
};

/// @returns nothing when the point is out of sight: behind, outside the image, too near or too
/// far for its octaves, or more than 60 degrees from where it was seen. Source: Mur-Artal and
/// Tardos 2015, V-D.
std::optional<ExpectedView> ExpectView(const MapPoint& point, const Pose& T_cw,
                                       const Camera& camera, const FeatureScale& scale);

/// The query for a map point from a pose; `point` is kNone when it is out of sight.
/// @param radius_factor  times the configured radius
PointQuery QueryOf(const MapPoint& point, const Pose& T_cw, const Camera& camera,
                   const FeatureScale& scale, double radius_factor,
                   const PointProjectionConfig& config);

/// Whether a feature is where a point at p_c should be, and as far away, at 95 %.
bool AgreesWith(const PointFeature& feature, const Eigen::Vector3d& p_c, const Camera& camera,
                const FeatureScale& scale);

}  // namespace slam
