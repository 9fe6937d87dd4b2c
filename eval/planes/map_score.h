#pragma once

#include <optional>
#include <set>
#include <vector>

#include "eval/formats/run/run_map.h"
#include "eval/formats/sequence/scene_truth.h"
#include "eval/planes/association.h"
#include "eval/trajectory/alignment.h"
#include "eval/trajectory/nees.h"
#include "eval/trajectory/statistics.h"

namespace eval {

/// Of map planes without observations. Their normals are those of many frames.
inline constexpr double kMaxMapNormal_deg = 20.0;
/// Nearer than this, true planes are told by place.
inline constexpr double kSameOffset_m = 0.005;

inline constexpr double kMaxMapCornerError_m = 0.10;

/// Errors of map planes against their own covariances.
struct PlaneClaims {
  std::size_t count = 0;   ///< matched planes with a regular covariance
  Nees nees;               ///< of height and two slopes: three degrees of freedom
  std::size_t silent = 0;  ///< beyond kSilentSigmas in some direction
};

/// The final map against the truth. Planes that were merged into others stand for these.
struct MapScore {
  int planes = 0;            ///< planes of the final map
  int true_planes_seen = 0;  ///< that counted in at least one frame
  /// Whether its planes can be held to true ones: by decisions, or by outlines in the world of the
  /// truth. Where not, `matched`, `duplicates` and `spurious` say nothing.
  bool comparable = true;
  bool has_outlines = true;  ///< of a plane at least, where there are planes
  int matched = 0;           ///< those of them that are the majority of at least one map plane
  int duplicates = 0;        ///< map planes beyond the first with the same majority
  /// With >= 2 truths that have n_ij >= max(3, 5 % of n_.j); nothing without decisions.
  std::optional<int> merged;
  int spurious = 0;  ///< whose observations show mostly no scored plane, or that have none
  /// More planes lie on true ones with their normals turned round than as they stand.
  bool normals_turned = false;
  std::optional<Spread> normal_deg;  ///< oriented angle; of matched pairs, as all below
  std::optional<Spread> offset_mm;   ///< rms distance of the true vertices to the map plane
  std::optional<Spread> vertex_mm;   ///< corners matched one-to-one within kMaxMapCornerError_m
  std::optional<PlaneClaims> claims;           ///< in the world of the truth, as all of these
  std::optional<double> polygon_iou_median;    ///< in the true plane, of the map plane's hull
  std::optional<Spread> polygon_hausdorff_mm;  ///< of the same two outlines
  /// Share of the area of the true planes seen that is covered: of each by the best hull of its map
  /// planes, not by all of them together.
  std::optional<double> area_explained;
};

/// The plane of the final map that `id` became; a broken chain ends where it breaks.
int FinalMapPlane(const std::vector<RunMapPlane>& map, int id);
/// The plane of the map with that id; null if there is none. @param map  by rising id
const RunMapPlane* FindMapPlane(const std::vector<RunMapPlane>& map, int id);
/// Parameters of a map plane in the world of the truth.
Plane InTruthWorld(const Alignment& gauge, const Plane& pi_w);
/// Root mean square of the points' distances to the plane, metres.
double RmsDistance(const Plane& pi_g, const std::vector<Eigen::Vector3d>& points_g);

/// By the decisions of the run: a map plane shows the truth of most of its observations.
/// @param gauge    world of the run to world of the truth, the trajectory's; without one there are
///                 counts and no geometry
/// @param records  decisions, with the map ids of their time
/// @param seen     ids of true planes that counted in a frame
MapScore ScoreMap(const std::vector<RunMapPlane>& map, const SceneTruth& scene,
                  const std::optional<Alignment>& gauge,
                  const std::vector<AssociationRecord>& records, const std::set<int>& seen);

/// The same without decisions: a map plane shows the scored true plane whose outline it shares,
/// within kMaxMapNormal_deg, that is nearest to the middle of its own (at most kMaxTruthOffset_m;
/// equal within kSameOffset_m), and of these the one it shares most area with. Without a gauge none
/// shows any.
MapScore ScoreMap(const std::vector<RunMapPlane>& map, const SceneTruth& scene,
                  const std::optional<Alignment>& gauge, const std::set<int>& seen);

}  // namespace eval
