#include "slam/mapping/plane_fuse.h"

#include <algorithm>
#include <cmath>

#include "slam/associate/plane_comparison.h"
#include "slam/mapping/plane_cloud.h"
#include "slam/mapping/plane_evidence.h"
#include "slam/model/class_belief.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

int CovisibleFrames(const MapPlane& one, const MapPlane& other) {
  const auto found = one.covisible.find(other.id);
  return found == one.covisible.end() ? 0 : found->second;
}

/// Something that is now a part of one of them was split from what is now a part of the other.
bool WereSplit(const Map& map, const MapPlane& one, const MapPlane& other) {
  return std::any_of(map.planes.begin(), map.planes.end(), [&](const MapPlane& m) {
    return m.split_from != kNone &&
           std::minmax(CurrentPlane(map, m.id), CurrentPlane(map, m.split_from)) ==
               std::minmax(one.id, other.id);
  });
}

/// Hardly any frame that showed the one showed the other.
bool SeenInTurn(const MapPlane& one, const MapPlane& other) {
  constexpr double kMaxTogether = 0.25;  // of the frames that showed the one that was seen less
  return CovisibleFrames(one, other) <
         kMaxTogether * std::min(one.observations, other.observations);
}

/// Side of voxels that the points of both clouds surely fill: that of a large or far plane is coarse.
double FilledVoxel_m(const MapPlane& one, const MapPlane& other, double voxel_m) {
  for (const MapPlane* m : {&one, &other}) {
    if (m->points_w.empty()) continue;
    voxel_m =
        std::max(voxel_m, std::sqrt(m->area_m2 / static_cast<double>(m->points_w.size())));
  }
  return voxel_m;
}

/// Parameters agree, and clouds meet.
bool AgreeAndMeet(const MapPlane& one, const MapPlane& other, double max_chi2,
                  const PlaneMapConfig& config) {
  if (!(ComparePlanes(one, other).chi2 < max_chi2)) return false;
  return CloudOverlap(one.points_w, other.points_w, one.pi_w,
                      FilledVoxel_m(one, other, config.voxel_m)) > config.min_fused_overlap;
}

/// A pose that jumped farther than it knew found the surface a second time. Two surfaces that lie at
/// one place and face the same way, as a desk and a book on it, are mostly seen both in a frame: these
/// are seen in turn.
bool IsFoundAgain(const MapPlane& one, const MapPlane& other, const AssociationConfig& a,
                  const PlaneMapConfig& config) {
  constexpr double kMostOfIt = 0.5;  // of the smaller cloud's voxels
  constexpr int kNoReach = 0;        // strips one above the other come within a voxel
  if (!SeenInTurn(one, other)) return false;
  for (const double offset_m :
       {ComparePlanes(one, other).offset_m, ComparePlanes(other, one).offset_m}) {
    if (!(std::abs(offset_m) < a.gates.max_patch_offset_m)) return false;  // eq7
  }
  return CloudOverlap(one.points_w, other.points_w, one.pi_w,
                      FilledVoxel_m(one, other, config.voxel_m), kNoReach) > kMostOfIt;
}

/// The same surface twice: classes do not contradict, nobody has seen two, and either parameters or
/// the place say so.
bool OneSurface(const Map& map, const MapPlane& one, const MapPlane& other,
                const AssociationConfig& a, const PlaneMapConfig& config) {
  if (one.observations < config.min_fused_observations ||
      other.observations < config.min_fused_observations) {
    return false;
  }
  if (StepLiesBetween(one, other)) return false;
  if (!(Angle(one.pi_w.n, other.pi_w.n) < a.gates.max_normal_angle_rad)) return false;  // eq6
  if (!(SameClassOdds(one.class_belief, other.class_belief) > a.min_class_odds)) return false;
  // Two segments seen side by side again and again have shown any step there is.
  const bool side_by_side = CovisibleFrames(one, other) >= config.min_fused_observations;
  const double max_chi2 = side_by_side ? 0.5 * a.max_chi2 : a.max_chi2;
  if (!AgreeAndMeet(one, other, max_chi2, config) && !IsFoundAgain(one, other, a, config)) {
    return false;
  }
  // All landmarks are asked what they were split from: of few pairs alone.
  return !WereSplit(map, one, other);
}

/// Adds what `from` knows of its parameters to `into`.
void FuseEstimate(MapPlane& into, const MapPlane& from) {
  if (from.estimate.empty()) return;
  const PlaneEvidence known = BestKnown(from.estimate);
  AddObservation(into.estimate, known.pi, known.centroid, known.angle_sigma_rad,
                 known.offset_sigma_m, 1.0, from.estimate.world_variance_m2);
  into.estimate.frames += from.estimate.frames - 1.0;  // it came as one
  into.pi_w = into.estimate.Mean();
}

/// Evidence for all corners together.
double Evidence(const MapPlane& m) {
  double sum = 0.0;
  for (const double w : m.vertex_weights) sum += w;
  return sum;
}

/// `from` becomes a part of `into`.
void Fuse(MapPlane& into, MapPlane& from, const PlaneMapConfig& config) {
  FuseEstimate(into, from);
  for (const auto& [name, evidence] : from.class_belief) into.class_belief[name] += evidence;
  into.class_name = BelievedClass(into.class_belief);
  // The shape: clouds, outline, and the corners that are better known.
  into.voxel_m = MergeIntoCloud(
      into.points_w, from.points_w, {into.estimate.normal_w, 0.0}, into.estimate.origin_w,
      std::max({config.voxel_m, into.voxel_m, from.voxel_m}), config.max_cloud_points);
  std::vector<Eigen::Vector3d> extent_w = into.hull_w;
  extent_w.insert(extent_w.end(), from.hull_w.begin(), from.hull_w.end());
  Outline outline = ConvexOutline(extent_w, into.pi_w);
  into.hull_w = std::move(outline.hull_w);
  into.area_m2 = outline.area_m2;
  if (!into.points_w.empty()) into.centroid_w = CloudCentroid(into.points_w, into.pi_w);
  if (Evidence(from) > Evidence(into)) {
    into.vertices_w = from.vertices_w;
    into.vertex_weights = from.vertex_weights;
  }
  for (Eigen::Vector3d& vertex_w : into.vertices_w) vertex_w = ProjectOnto(into.pi_w, vertex_w);
  into.supposed.insert(into.supposed.end(), from.supposed.begin(), from.supposed.end());
  into.map_points.insert(from.map_points.begin(), from.map_points.end());
  into.observations += from.observations - CovisibleFrames(into, from);
  into.seen_px += from.seen_px;
  into.first_frame = std::min(into.first_frame, from.first_frame);
  into.first_seen_s = std::min(into.first_seen_s, from.first_seen_s);
  into.last_frame = std::max(into.last_frame, from.last_frame);
  into.last_seen_s = std::max(into.last_seen_s, from.last_seen_s);
  from.status = LandmarkStatus::kMerged;
  from.merged_into = into.id;
  // What a fused plane held is held by the other now.
  from.points_w.clear();
  from.supposed.clear();
  from.map_points.clear();
  from.parts.clear();
}

/// What was counted of the fused plane counts for the one that it became.
void MoveCounts(Map& map, int from, int into, std::map<int, int> MapPlane::*counts) {
  for (MapPlane& m : map.planes) {
    const auto found = (m.*counts).find(from);
    if (found == (m.*counts).end()) continue;
    if (m.id != into) (m.*counts)[into] += found->second;
    (m.*counts).erase(from);
  }
  MapPlane& gone = map.planes.At(from);
  for (const auto& [other, frames] : gone.*counts) {
    if (other != into) (map.planes.At(into).*counts)[other] += frames;
  }
  (gone.*counts).clear();
}

void DropCulledPoints(Map& map) {
  for (MapPlane& m : map.planes) {
    std::erase_if(m.map_points, [&](int id) {
      return id < 0 || id >= static_cast<int>(map.points.size()) ||
             map.points[static_cast<std::size_t>(id)].culled;
    });
  }
}

}  // namespace

int FusePlanes(Map& map, const AssociationConfig& association, const PlaneMapConfig& config) {
  DropCulledPoints(map);
  std::vector<MapPlane*> landmarks;
  for (MapPlane& m : map.planes) {
    if (m.status == LandmarkStatus::kLandmark) landmarks.push_back(&m);
  }
  int fused = 0;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    if (landmarks[i]->status == LandmarkStatus::kMerged) continue;
    for (std::size_t k = i + 1; k < landmarks.size(); ++k) {
      if (landmarks[k]->status == LandmarkStatus::kMerged) continue;
      if (!OneSurface(map, *landmarks[i], *landmarks[k], association, config)) continue;
      Fuse(*landmarks[i], *landmarks[k], config);
      MoveCounts(map, landmarks[k]->id, landmarks[i]->id, &MapPlane::covisible);
      MoveCounts(map, landmarks[k]->id, landmarks[i]->id, &MapPlane::stepped);
      ++fused;
      k = i;  // it has grown: look at the others again
    }
  }
  // Chains of fusions are resolved to their end.
  for (MapPlane& m : map.planes) {
    if (m.status == LandmarkStatus::kMerged) m.merged_into = CurrentPlane(map, m.id);
  }
  return fused;
}

}  // namespace slam
