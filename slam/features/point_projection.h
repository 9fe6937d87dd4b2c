#pragma once

#include <optional>

#include "slam/base/field_visitor.h"
#include "slam/features/match_features.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map_point.h"

namespace slam {

/// Where and how a map point is looked for. Defaults: ORB-SLAM2's.
struct PointProjectionConfig {
  double straight_view_cosine = 0.998;  // 3.6 degrees
  double straight_radius_px = 2.5;
  double radius_px = 4.0;
};

inline void VisitFields(PointProjectionConfig& c, FieldVisitor& v) {
  v.Number("straight_view_cosine", c.straight_view_cosine, "[-1, 1]",
           "cosine between ray and mean view from which on the smaller search radius is used");
  v.Number("straight_radius_px", c.straight_radius_px, "(0, inf)",
           "search radius at octave 0 for a point seen from where it was seen before");
  v.Number("radius_px", c.radius_px, "(0, inf)",
           "search radius at octave 0 for a point seen from another side");
}

/// How a map point should look from a pose.
struct ExpectedView {
  Eigen::Vector2d u_px;  ///< in the ideal (undistorted) image
  int octave = 0;
  double cosine = 1.0;  ///< between its ray and the mean view
};

/// @returns nothing when the point is out of sight: behind, outside the image, too near or too
/// far for its octaves, or more than 60 degrees from where it was seen. Source: Mur-Artal and
/// Tardos 2015, V-D.
std::optional<ExpectedView> ExpectView(const MapPoint& point, const Pose& T_cw,
                                       const Camera& camera, const FeatureScale& scale);

/// The query for a map point from a pose; `point` is kNone when it is out of sight.
/// @param radius_factor  multiplies the configured radius
PointQuery QueryOf(const MapPoint& point, const Pose& T_cw, const Camera& camera,
                   const FeatureScale& scale, double radius_factor,
                   const PointProjectionConfig& config);

/// Whether a feature is where a point at p_c should be, and as far away, at 95 %.
bool AgreesWith(const PointFeature& feature, const Eigen::Vector3d& p_c, const Camera& camera,
                const FeatureScale& scale);

}  // namespace slam
