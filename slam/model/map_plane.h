#pragma once

#include <Eigen/Core>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "slam/base/index.h"
#include "slam/geometry/plane.h"
#include "slam/model/plane_estimate.h"
#include "slam/model/supposed_plane.h"

namespace slam {

/// How far a surface has come on its way into the map.
enum class LandmarkStatus {
  kCandidate,  ///< seen, but not often enough to be believed: constrains nothing
  kLandmark,
  kMerged  ///< found to be the same surface as another landmark, which stands for both
};

/// How far apart a corner that is seen and a known one may be to be one, metres: beyond what edge lines
/// and pose err by, and less than the sides of what lies on a desk.
inline constexpr double kMaxVertexJump_m = 0.05;

struct PlanePart;

/// A surface of the map: a patch with a front, in the world frame.
struct MapPlane {
  int id = kNone;  ///< given by MapPlanes, never reused
  LandmarkStatus status = LandmarkStatus::kCandidate;
  int merged_into = kNone;  ///< id of the landmark that stands for this one, when merged
  int split_from = kNone;   ///< id of the landmark that turned out to hold this one as well
  double split_at_s = 0.0;  ///< time of the frame in which it did

  Plane pi_w;  ///< keeps the orientation of its first observation
  Eigen::Vector3d centroid_w = Eigen::Vector3d::Zero();
  PlaneEstimate estimate;  ///< where pi_w comes from, and how well it is known; may be empty
  std::map<std::string, double> class_belief;  ///< summed evidence; "" stands for class -1
  std::string class_name;                      ///< the class believed in; empty is class -1

  std::vector<Eigen::Vector3d> points_w;  ///< thinned cloud of all observations
  double voxel_m = 0.0;  ///< side of its voxels, one point each; 0: no cloud yet
  std::vector<Eigen::Vector3d> vertices_w;  ///< corners in order; 4 when known, else fewer
  std::vector<double> vertex_weights;       ///< parallel to vertices_w: evidence for each
  std::vector<Eigen::Vector3d> hull_w;      ///< convex outline of the cloud, in order
  double area_m2 = 0.0;                     ///< inside the hull

  std::vector<SupposedPlane> supposed;  ///< through its edges; see slam/structure

  std::set<int> map_points;      ///< ids of the map points that lie on it
  std::map<int, int> covisible;  ///< id of another landmark -> frames in which both were seen
  std::map<int, int> stepped;    ///< the same -> frames that showed a step between the two
  int observations = 0;
  double seen_px = 0.0;  ///< summed size of the segments that showed it, pixels
  int first_frame = 0, last_frame = 0;
  double first_seen_s = 0.0, last_seen_s = 0.0;

  std::vector<PlanePart> parts;  ///< on trial as surfaces of their own
};

/// A part of a landmark that frames showed beyond a step.
struct PlanePart {
  MapPlane surface;               ///< the part alone, as those frames saw it
  MapPlane rest;                  ///< what lay on the other side of the step
  int seen = 0;                   ///< frames that showed the part and more of the landmark
  int apart = 0;                  ///< those of them that showed the step
  double step_information = 0.0;  ///< 1/m^2, of the part's height over the rest at the step
  double step_weighted = 0.0;     ///< that information times the height
};

}  // namespace slam
