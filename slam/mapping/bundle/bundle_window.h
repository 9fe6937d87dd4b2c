#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "slam/geometry/camera.h"
#include "slam/mapping/bundle/bundle_terms.h"
#include "slam/mapping/bundle/in_plane_terms.h"
#include "slam/mapping/bundle/local_bundle.h"
#include "slam/mapping/bundle/plane_terms.h"
#include "slam/model/map.h"

namespace slam {

/// A landmark that is adjusted, or a plane supposed at an edge of it.
struct WindowPlane {
  int id = kNone;                         ///< the landmark's
  bool supposed = false;                  ///< helps to find poses, and is not taken over itself
  Plane start_w;                          ///< where it was when the window was taken
  Eigen::Vector3d reference_w;            ///< of its block
  PlaneEstimate outside;                  ///< what keyframes outside say; may be empty
  std::unique_ptr<PlanePriorTerm> prior;  ///< the same; null when it is empty
};

/// What takes part in an adjustment, copied from the map: the map may go on growing while the
/// window is solved. In the order of ids, which fixes the order of the solver's sums; blocks of
/// one kind stand side by side, because the solver orders them by address.
struct BundleWindow {
  std::vector<int> keyframes;  ///< free ones, then fixed ones
  std::size_t free_count = 0;
  std::vector<int> points;
  std::vector<PoseBlock> poses;                  ///< parallel to keyframes
  std::vector<std::array<double, 3>> positions;  ///< parallel to points

  struct Observation {
    int keyframe, point;               ///< ids
    std::size_t pose_at, position_at;  ///< into the blocks
    bool stereo = false;               ///< the feature has depth
    bool inlier = true;                ///< takes part
    std::unique_ptr<BundleTerm> term;
    std::unique_ptr<InPlaneTerm<3>> in_plane;  ///< the same, of a coplanar point
  };
  std::vector<Observation> observations;

  std::vector<WindowPlane> planes;
  std::vector<std::unique_ptr<StayTerm>> stays;  ///< of the free poses, when there are planes
  std::vector<PlaneBlock> plane_blocks;          ///< parallel to planes
  struct PlaneObservation {
    int keyframe;         ///< id
    std::size_t seen_at;  ///< into the keyframe's planes
    std::size_t pose_at, plane_at;
    bool inlier = true;
    std::unique_ptr<PlaneTerm> term;
  };
  std::vector<PlaneObservation> plane_observations;
  struct PointOnPlane {
    std::size_t position_at, plane_at;
    bool inlier = true;
    std::unique_ptr<PointOnPlaneTerm> term;
  };
  std::vector<PointOnPlane> points_on_planes;

  /// A point of a plane.
  struct CoplanarPoint {
    std::size_t plane_at;
    PlaneAxes axes;
    bool held = true;  ///< false: it turned out to lie off the plane
  };
  std::map<std::size_t, CoplanarPoint> coplanar;  ///< by the place among the positions
  bool IsHeld(std::size_t position_at) const {
    const auto at = coplanar.find(position_at);
    return at != coplanar.end() && at->second.held;
  }

  struct Corner {
    std::size_t plane_at;
    PlaneAxes axes;
  };
  std::vector<Corner> corners;
  std::vector<InPlaneBlock> corner_blocks;  ///< parallel to corners
  struct CornerObservation {
    std::size_t pose_at, corner_at;
    bool inlier = true;
    std::unique_ptr<VertexTerm> term;
    std::unique_ptr<InPlaneTerm<2>> in_plane;
  };
  std::vector<CornerObservation> corner_observations;

  std::size_t map_keyframes = 0, map_points = 0;  ///< sizes of the map when it was copied
};

/// The window of AdjustLocalBundle.
BundleWindow LocalWindow(const Map& map, int keyframe, const Camera& camera,
                         const FeatureScale& scale, const LocalBundleConfig& config);

/// Everything: all keyframes but the first are free.
BundleWindow FullWindow(const Map& map, const Camera& camera, const FeatureScale& scale,
                        const LocalBundleConfig& config);

/// Two rounds: robust, then plain without the outliers. Touches no map.
/// @returns its report; when it is not usable the window must not be merged
LocalBundleReport SolveWindow(BundleWindow& window, const LocalBundleConfig& config);

/// Takes a usable solution over into the map. Keyframes that came meanwhile, and the points
/// that they brought, move as the window's newest keyframe does; a landmark moves with all that
/// it has as what its keyframes saw of it does (MergePlanes). Observations that are no inliers are taken back.
/// @pre nothing else moved poses or fused, culled or removed keyframes meanwhile
/// @returns ids of the landmarks that were placed
std::set<int> MergeWindow(const BundleWindow& window, const FeatureScale& scale, Map& map);

}  // namespace slam
