#pragma once

#include "slam/features/match_features.h"
#include "slam/geometry/camera.h"
#include "slam/model/map_point.h"
#include "slam/model/scale_pyramid.h"

namespace slam {

/// Where and how a map point is looked for.
struct PointProjectionConfig {
  ScalePyramid scales;
  double bf_px_m = 40.0;                ///< b f of the virtual right camera
  double min_view_cosine = 0.5;         ///< of the turn from the mean view; domain [-1, 1]
  double straight_view_cosine = 0.998;  ///< from here on the smaller radius
  double straight_radius_px = 2.5;      ///< search radius at octave 0, seen as before
  double radius_px = 4.0;               ///< ... and seen from another side
  double range_margin = 1.2;            ///< on the range of distances; domain [1, inf)
};

/// The query for a map point from a pose, or nothing (`point` is kNone) when the point is out
/// of sight: behind, outside the image, too near, too far, seen from behind.
/// @param radius_factor of the configured radius
PointQuery QueryOf(const MapPoint& point, const Pose& T_cw, const Camera& camera,
                   double radius_factor, const PointProjectionConfig& config);

}  // namespace slam
