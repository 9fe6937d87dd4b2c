#pragma once

#include "slam/base/field_visitor.h"
#include "slam/geometry/camera.h"
#include "slam/mapping/map_turn.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map.h"

namespace slam {

/// Bounds and weights of the local bundle adjustment.
struct LocalBundleConfig {
  double depth_sigma_px = 0.3;
  int max_keyframes = 10;
  int max_fixed_keyframes = 20;
  int first_iterations = 5;
  int last_iterations = 5;
};

inline void VisitFields(LocalBundleConfig& c, FieldVisitor& v) {
  v.Number("depth_sigma_px", c.depth_sigma_px, "(0, inf)",
           "standard deviation of the virtual disparity at octave 0");
  v.Integer("max_keyframes", c.max_keyframes, "[1, 1000]",
            "largest number of keyframes whose poses are adjusted");
  v.Integer("max_fixed_keyframes", c.max_fixed_keyframes, "[1, 1000]",
            "largest number of keyframes that hold the adjusted ones in place");
  v.Integer("first_iterations", c.first_iterations, "[0, 1000]",
            "iterations with Huber's weights, before outliers are left out");
  v.Integer("last_iterations", c.last_iterations, "[0, 1000]",
            "iterations with plain squares, after outliers are left out");
}

/// Size and outcome of one adjustment.
struct LocalBundleReport {
  int keyframes = 0, fixed_keyframes = 0;
  int outliers = 0;  ///< observations taken back
  double initial_cost = 0.0;
  bool usable = false;  ///< solved and finite; otherwise the map is as before
};

/// Adjusts the poses of `keyframe` and of those that share the most points with it, and all
/// points that they see; other keyframes that see these points stay fixed. The residual of an
/// observation is, in sigmas of its octave,
///   ( fx x/z + cx - u,  fy y/z + cy - v,  (b f / z - b f / z_measured) / depth_sigma_px ),
/// (x, y, z) = T_cw p_w; the third with depth alone. Ceres, Schur complement, one thread,
/// bounded iterations: same map, same bytes. The gauge is held by the fixed keyframes; when
/// there are none, by the oldest of the window.
/// @param turn  the map is needed before and after, not while the window is solved
LocalBundleReport AdjustLocalBundle(Map& map, int keyframe, const Camera& camera,
                                    const FeatureScale& scale, const LocalBundleConfig& config,
                                    const MapTurn& turn = AtOnce);

}  // namespace slam
