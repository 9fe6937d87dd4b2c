#include "slam/mapping/bundle_planes.h"

#include <algorithm>
#include <set>

#include "slam/base/chi_square.h"
#include "slam/base/index.h"
#include "slam/mapping/keyframe_planes.h"
#include "slam/mapping/plane_motion.h"

namespace slam {
namespace {

/// A keyframe's plane that shows a landmark.
struct Sighting {
  int keyframe;         ///< id
  std::size_t seen_at;  ///< into its planes
};

/// Who has seen which landmark, by its id.
std::map<int, std::vector<Sighting>> SightingsOfLandmarks(const Map& map) {
  std::map<int, std::vector<Sighting>> sightings;
  for (const Keyframe& keyframe : map.keyframes) {
    for (std::size_t i = 0; i < keyframe.planes.size(); ++i) {
      const MapPlane* landmark = LandmarkOf(map, keyframe.planes[i]);
      if (landmark != nullptr) sightings[landmark->id].push_back({keyframe.id, i});
    }
  }
  return sightings;
}

/// Adds what a keyframe outside has seen, unless it contradicts the landmark as it is.
/// @returns whether it was added
bool AddOutside(const Keyframe& keyframe, const KeyframePlane& seen, WindowPlane& plane) {
  const PoseBlock pose = BlockOf(keyframe.T_cw);
  const PlaneBlock block = BlockOf(plane.start_w, plane.reference_w);
  const double* blocks[] = {pose.data(), block.data()};
  Eigen::Vector4d residual;
  PlaneTerm(seen, plane.reference_w).Evaluate(blocks, residual.data(), nullptr);
  if (!(residual.squaredNorm() < kChi2Of3At999)) return false;
  const Pose T_wc = Inverse(keyframe.T_cw);
  AddObservation(plane.outside, Transform(T_wc, seen.pi_c), T_wc * seen.centroid_c,
                 seen.angle_sigma_rad, seen.offset_sigma_m, 1.0);
  return true;
}

/// Adds a landmark with all that keyframes have seen of it, if that can tell anything: one
/// keyframe alone agrees with any pose.
void AddLandmark(const Map& map, const MapPlane& landmark,
                 const std::vector<Sighting>& sightings,
                 const std::map<int, std::size_t>& pose_at, BundleWindow& window) {
  WindowPlane plane{landmark.id, landmark.pi_w, landmark.centroid_w, {}, nullptr};
  std::vector<BundleWindow::PlaneObservation> inside;
  std::set<int> keyframes;
  bool moves = false;
  for (const Sighting& s : sightings) {
    const Keyframe& keyframe = map.keyframes[Index(s.keyframe)];
    const KeyframePlane& seen = keyframe.planes[s.seen_at];
    const auto at = pose_at.find(s.keyframe);
    if (at == pose_at.end()) {
      if (AddOutside(keyframe, seen, plane)) keyframes.insert(s.keyframe);
      continue;
    }
    inside.push_back({s.keyframe, s.seen_at, at->second, window.planes.size(), true,
                      std::make_unique<PlaneTerm>(seen, plane.reference_w)});
    keyframes.insert(s.keyframe);
    moves = moves || at->second < window.free_count;
  }
  if (!moves || keyframes.size() < 2) return;
  std::move(inside.begin(), inside.end(), std::back_inserter(window.plane_observations));
  if (!plane.outside.empty())
    plane.prior = std::make_unique<PlanePriorTerm>(plane.outside, plane.reference_w);
  window.plane_blocks.push_back(BlockOf(plane.start_w, plane.reference_w));
  window.planes.push_back(std::move(plane));
}

/// Ties the window's points that lie on its newest plane to it.
void AddPointsOn(const MapPlane& landmark, double sigma_m, BundleWindow& window) {
  for (const int id : landmark.map_points) {
    const auto at = std::lower_bound(window.points.begin(), window.points.end(), id);
    if (at == window.points.end() || *at != id) continue;
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
    const std::size_t before = window.planes.size();
    AddLandmark(map, landmark, sightings, pose_at, window);
    if (config.use_point_planes && window.planes.size() > before)
      AddPointsOn(landmark, config.point_plane_sigma_m, window);
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
    MapPlane& landmark = map.planes.At(window.planes[i].id);
    if (landmark.status != LandmarkStatus::kLandmark) continue;  // merged meanwhile
    if (now_w[i].empty()) continue;                              // nobody counts any more
    MovePlane(landmark,
              MotionBetween(before_w[i].Mean(), now_w[i].Mean(), window.planes[i].reference_w));
    placed.insert(landmark.id);
  }
  for (const BundleWindow::PlaneObservation& o : window.plane_observations) {
    if (!o.inlier) map.keyframes[Index(o.keyframe)].planes[o.seen_at].map_plane = kNone;
  }
  for (const BundleWindow::PointOnPlane& o : window.points_on_planes) {
    if (!o.inlier)
      map.planes.At(window.planes[o.plane_at].id)
          .map_points.erase(window.points[o.position_at]);
  }
  return placed;
}

}  // namespace slam
