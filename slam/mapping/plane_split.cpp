#include "slam/mapping/plane_split.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "slam/associate/frame_relations.h"
#include "slam/associate/plane_comparison.h"
#include "slam/associate/plane_overlap.h"
#include "slam/base/chi_square.h"
#include "slam/base/index.h"
#include "slam/mapping/plane_cloud.h"
#include "slam/mapping/plane_evidence.h"
#include "slam/mapping/plane_observation.h"
#include "slam/mapping/plane_trial.h"

namespace slam {
namespace {

constexpr double kMostOfPart = 0.5;     // of its cloud: less may be a neighbour's edge
constexpr std::size_t kMaxParts = 4;    // of a landmark: bounds memory and time
constexpr double kMinWholeRatio = 1.5;  // what is more than the part by half is more than it

/// Two planes of the frame that show one landmark with a step between them.
struct PartSighting {
  std::size_t part = 0, rest = 0;  ///< frame planes
  double step_m = 0.0;             ///< height of the part over the rest
  double sigma_m = 0.0;
};

/// Larger first; an order that does not depend on that of the frame's planes.
bool IsLarger(const FramePlane& one, const FramePlane& other) {
  const auto key = [](const FramePlane& f) {
    return std::tuple(f.pixel_count, f.centroid_c.x(), f.centroid_c.y());
  };
  return key(one) > key(other);
}

/// Share of the smaller of two clouds that they have in common: in the voxels beside, which errors
/// of the pose do not change, plus in the voxels themselves, which tells neighbours apart. 0 where
/// they have not most of it in common.
double InCommon(const std::vector<Eigen::Vector3d>& one_w,
                const std::vector<Eigen::Vector3d>& other_w, const Plane& pi_w,
                double voxel_m) {
  const double beside = CloudOverlap(one_w, other_w, pi_w, voxel_m);
  if (!(beside > kMostOfPart)) return 0.0;
  return beside + CloudOverlap(one_w, other_w, pi_w, voxel_m, 0);
}

/// A part of a landmark that a plane of the frame lies on.
struct PartShown {
  std::size_t part = 0;    ///< index
  double in_common = 0.0;  ///< 0: none
};

PartShown FindPart(const MapPlane& m, const FramePlane& plane, const Frame& frame,
                   const PlaneMapConfig& config) {
  PartShown found;
  if (m.parts.empty()) return found;
  const auto points_w = PointsInWorld(plane.points_c, Inverse(frame.T_cw));
  for (std::size_t i = 0; i < m.parts.size(); ++i) {
    const MapPlane& surface = m.parts[i].surface;
    const double in_common =
        InCommon(surface.points_w, points_w, m.pi_w, std::max(config.voxel_m, surface.voxel_m));
    if (in_common > found.in_common) found = {i, in_common};
  }
  return found;
}

/// The plane on the part's side of a step: the one that shows a known part, or else the lesser.
PartSighting SightingOf(const FrameStep& step, const MapPlane& m, const Frame& frame,
                        const PlaneMapConfig& config) {
  PartSighting out{Index(step.one), Index(step.other), step.step_m, step.sigma_m};
  const FramePlane &one = frame.planes[out.part], &other = frame.planes[out.rest];
  const double ours = FindPart(m, one, frame, config).in_common;
  const double others = FindPart(m, other, frame, config).in_common;
  if (others > ours || (others == ours && IsLarger(one, other))) {
    std::swap(out.part, out.rest);
    out.step_m = -out.step_m;
  }
  return out;
}

/// What the frame shows of a landmark beyond steps: each part once, beside the largest plane.
std::vector<PartSighting> Sightings(const MapPlane& m, const Frame& frame,
                                    const PlaneMapConfig& config) {
  std::vector<PartSighting> all;
  for (const FrameStep& step : frame.plane_steps) {
    const auto shows = [&](int f) {
      const PlaneMatch& match = frame.plane_matches[Index(f)];
      return match.decision == PlaneDecision::kMatched && match.map_plane == m.id;
    };
    if (shows(step.one) && shows(step.other)) all.push_back(SightingOf(step, m, frame, config));
  }
  std::sort(all.begin(), all.end(), [&](const PartSighting& a, const PartSighting& b) {
    if (a.part != b.part) return IsLarger(frame.planes[a.part], frame.planes[b.part]);
    return IsLarger(frame.planes[a.rest], frame.planes[b.rest]);
  });
  all.erase(std::unique(all.begin(), all.end(),
                        [](const auto& a, const auto& b) { return a.part == b.part; }),
            all.end());
  return all;
}

/// One plane fits another of the same frame no better than two surfaces would.
bool Disagree(const FramePlane& one, const FramePlane& other,
              const AssociationConfig& association) {
  return std::max(ComparePlanes(one, other, association).chi2,
                  ComparePlanes(other, one, association).chi2) >= association.max_chi2;
}

/// The frame shows the part, and more of the landmark with it, and nothing between them.
bool IsSeenAsOne(const PlanePart& part, int landmark, const Frame& frame, const Camera& camera,
                 const AssociationConfig& association) {
  const PlaneView view = ViewMapPlane(part.surface, frame, frame.T_cw, camera);
  // The planes that show the landmark, and the one that most of the part lies on.
  std::vector<std::size_t> shown;
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    const PlaneMatch& match = frame.plane_matches[f];
    if (match.ShowsLandmark() && match.map_plane == landmark) shown.push_back(f);
  }
  if (shown.empty()) return false;
  const auto fewer = [&](std::size_t f, std::size_t g) {
    return view.landed[f] < view.landed[g];
  };
  const FramePlane& home = frame.planes[*std::max_element(shown.begin(), shown.end(), fewer)];
  int landed = 0;
  double area_m2 = 0.0;
  for (const std::size_t f : shown) {
    landed += view.landed[f];
    area_m2 += frame.planes[f].area_m2;
    // Planes that do not fit each other have no step measured: that says nothing.
    if (Disagree(home, frame.planes[f], association)) return false;
  }
  return landed > kMostOfPart * static_cast<double>(part.surface.points_w.size()) &&
         area_m2 > kMinWholeRatio * landed * view.cell_m2;
}

/// The part that a sighting shows, a new one where it shows none of those known.
std::size_t PartFor(const PartSighting& sighting, const Frame& frame,
                    const PlaneMapConfig& config, MapPlane& m) {
  const FramePlane& plane = frame.planes[sighting.part];
  const PartShown found = FindPart(m, plane, frame, config);
  if (found.in_common > 0) return found.part;
  if (m.parts.size() == kMaxParts) {
    const auto least =
        std::min_element(m.parts.begin(), m.parts.end(),
                         [](const auto& a, const auto& b) { return a.apart < b.apart; });
    m.parts.erase(least);
  }
  m.parts.emplace_back();
  m.parts.back().surface = StartPlane(plane, frame);
  m.parts.back().rest = StartPlane(frame.planes[sighting.rest], frame);
  return m.parts.size() - 1;
}

/// Both sides of a step, each by itself, and the step.
void Learn(const PartSighting& sighting, const Frame& frame, const PlaneMapConfig& config,
           PlanePart& part) {
  const FramePlane &plane = frame.planes[sighting.part], &rest = frame.planes[sighting.rest];
  ObservePlane(part.surface, plane, frame, config);
  ObservePlane(part.rest, rest, frame, config);
  // Frames from one place see the step through the same bends.
  const double share = part.apart == 0 ? 1.0 : std::sqrt(SharedBend(plane, frame));
  const double bend_m = share * frame.bend_ratio * std::abs(plane.pi_c.d);
  const double sigma_m = std::hypot(sighting.sigma_m, bend_m);
  const double information = 1.0 / (sigma_m * sigma_m);
  part.step_information = config.keep_information * part.step_information + information;
  part.step_weighted =
      config.keep_information * part.step_weighted + information * sighting.step_m;
  ++part.apart, ++part.seen;
}

/// Everything that a split needs (plane_split.h).
bool IsOfItsOwn(const PlanePart& part, const PlaneMapConfig& config) {
  if (!HasProvenItself(part.surface, config) || 2 * part.apart <= part.seen) return false;
  const double step_m = part.step_weighted / part.step_information;
  if (!(std::abs(step_m) * std::sqrt(part.step_information) > kCertainStep_sigmas))
    return false;
  const double height_m = SignedDistance(part.rest.pi_w, part.surface.centroid_w);
  return height_m * step_m > 0 && ComparePlanes(part.surface, part.rest).chi2 > kChi2Of3At95;
}

/// Squared distance within the plane to the nearest point of a cloud.
double NearestSquared(const std::vector<Eigen::Vector3d>& cloud_w, const Eigen::Vector3d& p_w,
                      const Eigen::Vector3d& n_w) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& q_w : cloud_w)
    nearest = std::min(nearest, n_w.cross(q_w - p_w).squaredNorm());
  return nearest;
}

/// The landmark without what lies nearer to the part than to the rest, as frames saw both.
MapPlane RestOf(const MapPlane& m, const PlanePart& part, const Map& map) {
  MapPlane rest = m;
  rest.parts.clear();
  rest.estimate = part.rest.estimate;
  rest.pi_w = part.rest.pi_w;
  const auto is_of_part = [&](const Eigen::Vector3d& p_w) {
    return NearestSquared(part.surface.points_w, p_w, m.pi_w.n) <
           NearestSquared(part.rest.points_w, p_w, m.pi_w.n);
  };
  std::erase_if(rest.points_w, is_of_part);
  std::erase_if(rest.map_points,
                [&](int point) { return is_of_part(map.points[Index(point)].p_w); });
  // The shape of what is left.
  Outline outline = ConvexOutline(rest.points_w, rest.pi_w);
  rest.hull_w = std::move(outline.hull_w);
  rest.area_m2 = outline.area_m2;
  // Its corners, on its own plane.
  std::vector<Eigen::Vector3d> corners_w;
  std::vector<double> weights;
  for (std::size_t i = 0; i < m.vertices_w.size(); ++i) {
    if (is_of_part(m.vertices_w[i])) continue;
    corners_w.push_back(ProjectOnto(rest.pi_w, m.vertices_w[i]));
    weights.push_back(m.vertex_weights[i]);
  }
  rest.vertices_w = std::move(corners_w);
  rest.vertex_weights = std::move(weights);
  if (!rest.points_w.empty()) rest.centroid_w = CloudCentroid(rest.points_w, rest.pi_w);
  return rest;
}

/// The id and the history of a landmark go to its larger side.
void TakePlaceOf(const MapPlane& m, MapPlane& larger) {
  larger.id = m.id;
  larger.status = m.status;
  larger.split_from = m.split_from;
  larger.split_at_s = m.split_at_s;
  larger.covisible = m.covisible;
  larger.stepped = m.stepped;
  larger.observations = m.observations;
  larger.seen_px = m.seen_px;
  larger.first_frame = m.first_frame;
  larger.first_seen_s = m.first_seen_s;
  larger.last_frame = m.last_frame;
  larger.last_seen_s = m.last_seen_s;
}

/// Makes two landmarks of one. @returns whether something is left of the rest
bool Split(int id, std::size_t which, const PartSighting& sighting, Frame& frame, Map& map) {
  MapPlane& m = map.planes.At(id);
  const PlanePart part = m.parts[which];
  MapPlane rest = RestOf(m, part, map), surface = part.surface;
  if (rest.hull_w.empty() || surface.hull_w.empty()) return false;
  for (const int point : m.map_points) {
    if (!rest.map_points.contains(point)) surface.map_points.insert(point);
  }
  const bool part_is_larger = surface.area_m2 > rest.area_m2;
  MapPlane& larger = part_is_larger ? surface : rest;
  MapPlane& lesser = part_is_larger ? rest : surface;
  TakePlaceOf(m, larger);
  lesser.status = LandmarkStatus::kLandmark;
  lesser.split_from = id;
  lesser.split_at_s = frame.timestamp_s;
  const MapPlane& seen_apart = part_is_larger ? part.rest : part.surface;
  lesser.observations = seen_apart.observations;
  lesser.seen_px = seen_apart.seen_px;
  // Frames with both; this one is counted with those of all landmarks.
  const int seen = part.seen - 1, apart = part.apart - 1;
  lesser.covisible = {{id, seen}};
  lesser.stepped = {{id, apart}};
  m = std::move(larger);
  const int made = map.planes.Add(std::move(lesser)).id;
  map.planes.At(id).covisible[made] = seen;
  map.planes.At(id).stepped[made] = apart;
  frame.plane_matches[part_is_larger ? sighting.rest : sighting.part] = {
      PlaneDecision::kNew, made, MatchReason::kSplit};
  return true;
}

/// Counts the frame for or against the parts of a landmark. @returns whether it was split
bool Judge(int id, const Camera& camera, const AssociationConfig& association,
           const PlaneMapConfig& config, Frame& frame, Map& map) {
  MapPlane& m = map.planes.At(id);
  const std::vector<PartSighting> sightings = Sightings(m, frame, config);
  if (sightings.empty() && m.parts.empty()) return false;
  // Where the frame shows a part beyond a step, both sides are learnt.
  for (const PartSighting& sighting : sightings) {
    const std::size_t which = PartFor(sighting, frame, config, m);
    PlanePart& part = m.parts[which];
    if (part.surface.last_frame == frame.index) continue;  // several segments of one part
    Learn(sighting, frame, config, part);
    if (IsOfItsOwn(part, config) && Split(id, which, sighting, frame, map)) {
      return true;
    }
  }
  // The other parts were seen without one.
  for (PlanePart& part : m.parts) {
    if (part.surface.last_frame != frame.index &&
        IsSeenAsOne(part, id, frame, camera, association))
      ++part.seen;
  }
  return false;
}

}  // namespace

int SplitPlanes(Frame& frame, Map& map, const Camera& camera,
                const AssociationConfig& association, const PlaneMapConfig& config) {
  std::vector<int> shown;  // landmarks, by rising id
  for (const PlaneMatch& match : frame.plane_matches) {
    if (match.decision == PlaneDecision::kMatched) shown.push_back(match.map_plane);
  }
  std::sort(shown.begin(), shown.end());
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  int split = 0;
  for (const int id : shown)
    split += Judge(id, camera, association, config, frame, map) ? 1 : 0;
  return split;
}

}  // namespace slam
