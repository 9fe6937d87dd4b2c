#pragma once

#include <Eigen/Core>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "slam/base/index.h"
#include "slam/geometry/plane.h"
#include "slam/model/plane_estimate.h"

namespace slam {

/// How far a surface has come on its way into the map.
enum class LandmarkStatus {
  kCandidate,  ///< seen, but not often enough to be believed: constrains nothing
  kLandmark,
  kMerged  ///< found to be the same surface as another landmark, which stands for both
};

/// A surface of the map: a patch with a front, in the world frame.
struct MapPlane {
  int id = kNone;  ///< given by MapPlanes, never reused
  LandmarkStatus status = LandmarkStatus::kCandidate;
  int merged_into = kNone;  ///< id of the landmark that stands for this one, when merged

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
  double area_m2 = 0.0;                        ///< inside the hull

  std::set<int> map_points;      ///< ids of the map points that lie on it
  std::map<int, int> covisible;  ///< id of another landmark -> frames in which both were seen
  std::map<int, int> stepped;    ///< the same -> frames that showed a step between the two
  int observations = 0;
  double seen_px = 0.0;  ///< summed size of the segments that showed it, pixels
  int first_frame = 0, last_frame = 0;
  double first_seen_s = 0.0, last_seen_s = 0.0;
};

}  // namespace slam
