#include "slam/mapping/bundle/bundle_planes.h"

#include <algorithm>
#include <optional>
#include <set>

#include "slam/base/chi_square.h"
#include "slam/base/index.h"
#include "slam/mapping/bundle/bundle_corners.h"
#include "slam/mapping/bundle/coplanar_points.h"
#include "slam/mapping/keyframe_planes.h"
#include "slam/mapping/plane_motion.h"

namespace slam {
namespace {

/// A keyframe's plane that shows a landmark.
struct Sighting {
  int keyframe;               ///< id
  std::size_t seen_at;        ///< into its planes
  const MeasuredPlane* seen;  ///< that plane, or one supposed at an edge of it
};

/// Who has seen which landmark, by its id.
std::map<int, std::vector<Sighting>> SightingsOfLandmarks(const Map& map) {
  std::map<int, std::vector<Sighting>> sightings;
  for (const Keyframe& keyframe : map.keyframes) {
    for (std::size_t i = 0; i < keyframe.planes.size(); ++i) {
      const MapPlane* landmark = LandmarkOf(map, keyframe.planes[i]);
      if (landmark != nullptr)
        sightings[landmark->id].push_back({keyframe.id, i, &keyframe.planes[i]});
    }
  }
  return sightings;
}

/// How far what a keyframe has seen is from a plane, in squared sigmas.
double SquaredResidual(const MeasuredPlane& seen, const Keyframe& keyframe, const Plane& pi_w,
                       const Eigen::Vector3d& reference_w) {
  const PoseBlock pose = BlockOf(keyframe.T_cw);
  const PlaneBlock block = BlockOf(pi_w, reference_w);
  const double* blocks[] = {pose.data(), block.data()};
  Eigen::Vector4d residual;
  PlaneTerm(seen, reference_w).Evaluate(blocks, residual.data(), nullptr);
  return residual.squaredNorm();
}

/// Adds what a keyframe outside has seen, unless it contradicts the landmark as it is.
/// @returns whether it was added
bool AddOutside(const Keyframe& keyframe, const MeasuredPlane& seen, WindowPlane& plane) {
  if (!(SquaredResidual(seen, keyframe, plane.start_w, plane.reference_w) < kChi2Of3At999))
    return false;
  const Pose T_wc = Inverse(keyframe.T_cw);
  AddObservation(plane.outside, Transform(T_wc, seen.pi_c), T_wc * seen.centroid_c,
                 seen.angle_sigma_rad, seen.offset_sigma_m, 1.0);
  return true;
}

/// Adds a plane with all that keyframes have seen of it, if that can tell anything: one keyframe
/// alone agrees with any pose.
/// @returns whether it was added
bool AddPlane(const Map& map, WindowPlane plane, const std::vector<Sighting>& sightings,
              const std::map<int, std::size_t>& pose_at, BundleWindow& window) {
  std::vector<BundleWindow::PlaneObservation> inside;
  std::set<int> keyframes;
  bool moves = false;
  for (const Sighting& s : sightings) {
    const Keyframe& keyframe = map.keyframes[Index(s.keyframe)];
    const auto at = pose_at.find(s.keyframe);
    if (at == pose_at.end()) {
      if (AddOutside(keyframe, *s.seen, plane)) keyframes.insert(s.keyframe);
      continue;
    }
    inside.push_back({s.keyframe, s.seen_at, at->second, window.planes.size(), true,
                      std::make_unique<PlaneTerm>(*s.seen, plane.reference_w)});
    keyframes.insert(s.keyframe);
    moves = moves || at->second < window.free_count;
  }
  if (!moves || keyframes.size() < 2) return false;
  std::move(inside.begin(), inside.end(), std::back_inserter(window.plane_observations));
  if (!plane.outside.empty())
    plane.prior = std::make_unique<PlanePriorTerm>(plane.outside, plane.reference_w);
  window.plane_blocks.push_back(BlockOf(plane.start_w, plane.reference_w));
  window.planes.push_back(std::move(plane));
  return true;
}

/// Which of the landmark's supposed planes shows at an edge of a keyframe: the one that contradicts
/// it least, or none.
std::optional<std::size_t> SupposedAt(const MeasuredPlane& edge, const Keyframe& keyframe,
                                      const std::vector<SupposedPlane>& known) {
  std::optional<std::size_t> nearest;
  double least = kChi2Of3At999;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const double off =
        SquaredResidual(edge, keyframe, known[i].pi_w, known[i].estimate.origin_w);
    if (!(off < least)) continue;
    least = off;
    nearest = i;
  }
  return nearest;
}

/// Adds the planes supposed at the landmark's edges, by what its keyframes have seen of these.
void AddEdges(const Map& map, const MapPlane& landmark, const std::vector<Sighting>& sightings,
              const std::map<int, std::size_t>& pose_at, BundleWindow& window) {
  std::vector<std::vector<Sighting>> at_edges(landmark.supposed.size());
  for (const Sighting& s : sightings) {
    const Keyframe& keyframe = map.keyframes[Index(s.keyframe)];
    for (const MeasuredPlane& edge : keyframe.planes[s.seen_at].edges) {
      const auto at = SupposedAt(edge, keyframe, landmark.supposed);
      if (at) at_edges[*at].push_back({s.keyframe, s.seen_at, &edge});
    }
  }
  for (std::size_t i = 0; i < at_edges.size(); ++i) {
    const SupposedPlane& supposed = landmark.supposed[i];
    AddPlane(map, {landmark.id, true, supposed.pi_w, supposed.estimate.origin_w, {}, nullptr},
             at_edges[i], pose_at, window);
  }
}

/// Ties the window's points that lie on its newest plane to it.
void AddPointsOn(const MapPlane& landmark, double sigma_m, BundleWindow& window) {
  for (const int id : landmark.map_points) {
    const auto at = std::lower_bound(window.points.begin(), window.points.end(), id);
    if (at == window.points.end() || *at != id) continue;
    if (window.IsHeld(static_cast<std::size_t>(at - window.points.begin()))) continue;
    window.points_on_planes.push_back(
        {static_cast<std::size_t>(at - window.points.begin()), window.planes.size() - 1, true,
         std::make_unique<PointOnPlaneTerm>(sigma_m, window.planes.back().reference_w)});
  }
}

/// What the keyframes that still count have seen of each landmark, from where they were or are.
std::vector<PlaneEstimate> SeenFrom(const BundleWindow& window, const Map& map,
                                    const std::vector<Pose>& poses_cw) {
  std::vector<PlaneEstimate> seen_w;
  for (const WindowPlane& plane : window.planes) seen_w.push_back(plane.outside);
  for (const BundleWindow::PlaneObservation& o : window.plane_observations) {
    if (!o.inlier) continue;
    const KeyframePlane& seen = map.keyframes[Index(o.keyframe)].planes[o.seen_at];
    const Pose T_wc = Inverse(poses_cw[o.pose_at]);
    AddObservation(seen_w[o.plane_at], Transform(T_wc, seen.pi_c), T_wc * seen.centroid_c,
                   seen.angle_sigma_rad, seen.offset_sigma_m, 1.0);
  }
  return seen_w;
}

}  // namespace

void AddPlanes(const Map& map, const std::map<int, std::size_t>& pose_at,
               const LocalBundleConfig& config, BundleWindow& window) {
  for (const auto& [id, sightings] : SightingsOfLandmarks(map)) {
    const MapPlane& landmark = map.planes.At(id);
    if (AddPlane(map, {id, false, landmark.pi_w, landmark.centroid_w, {}, nullptr}, sightings,
                 pose_at, window)) {
      if (config.use_coplanar_points) HoldToPlane(landmark, window);
      if (config.use_point_planes) AddPointsOn(landmark, config.point_plane_sigma_m, window);
      if (config.use_vertices) AddCorners(map, landmark, pose_at, window);
    }
    if (config.use_edges) AddEdges(map, landmark, sightings, pose_at, window);
  }
  // A plane leaves three directions of a pose open: where nothing else knows these, it stays.
  for (std::size_t i = 0; i < window.free_count && !window.planes.empty(); ++i) {
    window.stays.push_back(std::make_unique<StayTerm>(PoseOf(window.poses[i].data())));
  }
}

std::set<int> MergePlanes(const BundleWindow& window, Map& map) {
  std::vector<Pose> before_cw, now_cw;
  for (std::size_t i = 0; i < window.keyframes.size(); ++i) {
    before_cw.push_back(map.keyframes[Index(window.keyframes[i])].T_cw);
    now_cw.push_back(PoseOf(window.poses[i].data()));
  }
  const std::vector<PlaneEstimate> before_w = SeenFrom(window, map, before_cw);
  const std::vector<PlaneEstimate> now_w = SeenFrom(window, map, now_cw);
  std::set<int> placed;
  for (std::size_t i = 0; i < window.planes.size(); ++i) {
    if (window.planes[i].supposed) continue;
    MapPlane& landmark = map.planes.At(window.planes[i].id);
    if (landmark.status != LandmarkStatus::kLandmark) continue;  // merged meanwhile
    if (now_w[i].empty()) continue;                              // nobody counts any more
    MovePlane(landmark,
              MotionBetween(before_w[i].Mean(), now_w[i].Mean(), window.planes[i].reference_w));
    placed.insert(landmark.id);
  }
  for (const BundleWindow::PlaneObservation& o : window.plane_observations) {
    if (!o.inlier && !window.planes[o.plane_at].supposed)
      map.keyframes[Index(o.keyframe)].planes[o.seen_at].map_plane = kNone;
  }
  for (const BundleWindow::PointOnPlane& o : window.points_on_planes) {
    if (!o.inlier)
      map.planes.At(window.planes[o.plane_at].id)
          .map_points.erase(window.points[o.position_at]);
  }
  for (const auto& [position_at, point] : window.coplanar) {
    if (!point.held)
      map.planes.At(window.planes[point.plane_at].id)
          .map_points.erase(window.points[position_at]);
  }
  return placed;
}

}  // namespace slam
