#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "slam/geometry/plane.h"
#include "slam/model/plane_estimate.h"

namespace slam {

/// A landmark plane: a patch with a front, in the world frame. `id` is its index in Map::planes
/// and is never reused.
struct MapPlane {
  int id = 0;
  Plane pi_w;  ///< keeps the orientation of its first observation
  Eigen::Vector3d centroid_w = Eigen::Vector3d::Zero();
  PlaneEstimate estimate;  ///< where pi_w comes from, and how well it is known; may be empty
  std::map<std::string, double> class_belief;  ///< summed evidence; "" stands for class -1
  std::string class_name;                      ///< the class believed in; empty is class -1

  std::vector<Eigen::Vector3d> points_w;       ///< thinned cloud of all observations
  std::vector<Eigen::Vector3d> edge_points_w;  ///< thinned true boundary
  std::vector<Eigen::Vector3d> vertices_w;     ///< corners in order; 4 when known, else fewer
  std::vector<double> vertex_weights;          ///< parallel to vertices_w: evidence for each
  std::vector<Eigen::Vector3d> hull_w;         ///< convex outline of the cloud, in order
  double area_m2 = 0.0;                        ///< of the hull

  std::set<int> map_points;      ///< ids of the map points that lie on it
  std::map<int, int> covisible;  ///< map plane id -> frames in which both were seen
  int observations = 0;
  double seen_px = 0.0;  ///< summed size of the segments that showed it, pixels
  int first_frame = 0, last_frame = 0;
  double first_seen_s = 0.0, last_seen_s = 0.0;
  std::optional<int> merged_into;  ///< fused into this one: use that one instead
};

}  // namespace slam
