#pragma once

#include "slam/base/field_visitor.h"
#include "slam/geometry/camera.h"
#include "slam/mapping/map_turn.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map.h"

namespace slam {

/// Bounds and weights of the local bundle adjustment.
struct LocalBundleConfig {
  int max_keyframes = 10;
  int max_fixed_keyframes = 20;
  int first_iterations = 5;
  int last_iterations = 5;
  bool use_planes = true;
  bool use_point_planes = false;
  double point_plane_sigma_m = 0.005;
  bool use_coplanar_points = false;
  bool use_edges = false;
  bool use_vertices = false;
};

inline void VisitFields(LocalBundleConfig& c, FieldVisitor& v) {
  v.Integer("max_keyframes", c.max_keyframes, "[1, 1000]",
            "largest number of keyframes whose poses are adjusted");
  v.Integer("max_fixed_keyframes", c.max_fixed_keyframes, "[1, 1000]",
            "largest number of keyframes that hold the adjusted ones in place");
  v.Integer("first_iterations", c.first_iterations, "[0, 1000]",
            "iterations with Huber's weights, before outliers are left out");
  v.Integer("last_iterations", c.last_iterations, "[0, 1000]",
            "iterations with plain squares, after outliers are left out");
  v.Flag("use_planes", c.use_planes,
         "landmarks are adjusted too, by the planes of the keyframes (eq16)");
  v.Flag("use_point_planes", c.use_point_planes,
         "adjusted landmarks and the points that lie on them hold each other (eq18)");
  v.Number("point_plane_sigma_m", c.point_plane_sigma_m, "(0, inf)",
           "standard deviation of such a point's distance from its plane");
  v.Flag("use_coplanar_points", c.use_coplanar_points,
         "points that lie on an adjusted landmark are told by two numbers in its plane");
  v.Flag("use_edges", c.use_edges,
         "planes supposed at straight edges of landmarks are adjusted too (eq16)");
  v.Flag("use_vertices", c.use_vertices,
         "corners of adjusted landmarks are adjusted too, each by two numbers in its plane");
}

/// Size and outcome of one adjustment.
struct LocalBundleReport {
  int keyframes = 0, fixed_keyframes = 0;
  int outliers = 0;        ///< observations of points taken back
  int planes = 0;          ///< landmarks adjusted
  int plane_outliers = 0;  ///< observations of planes taken back
  double initial_cost = 0.0;
  bool usable = false;  ///< solved and finite; otherwise the map is as before
};

/// Adjusts the poses of `keyframe` and of those that share the most points with it, and all
/// points that they see; other keyframes that see these points stay fixed. The residual of an
/// observation is that of tracking (ResidualOf). Ceres, Schur complement, one thread,
/// bounded iterations: same map, same bytes. The gauge is held by the fixed keyframes; when
/// there are none, by the oldest of the window.
///
/// With config.use_planes the landmarks that the adjusted keyframes have seen move too: their
/// residuals are those of PlaneTerm, and what keyframes outside the window saw of them is a prior
/// (AddPlanes). After the first round observations of planes beyond their chi-square are left
/// out, and in the end taken off their keyframes, as those of points are.
/// @param turn  the map is needed before and after, not while the window is solved
LocalBundleReport AdjustLocalBundle(Map& map, int keyframe, const Camera& camera,
                                    const FeatureScale& scale, const LocalBundleConfig& config,
                                    const MapTurn& turn = AtOnce);

}  // namespace slam
