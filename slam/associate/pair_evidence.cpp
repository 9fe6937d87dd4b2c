#include "slam/associate/pair_evidence.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/associate/correct_prediction.h"
#include "slam/associate/occlusion.h"
#include "slam/associate/plane_overlap.h"
#include "slam/associate/plane_samples.h"
#include "slam/associate/projected_box.h"
#include "slam/associate/rank_test.h"
#include "slam/base/index.h"
#include "slam/model/class_belief.h"

namespace slam {
namespace {

/// Border and structure faults concern corners: such a plane may be recognised, not mapped.
bool CanBeMatched(const FramePlane& plane) {
  return !plane.bad || *plane.bad == BadReason::kBorder || *plane.bad == BadReason::kStructure;
}

/// What one map plane looks like from a pose.
struct MapPlaneView {
  PlaneView footprint;
  Box box_px;
};

MapPlaneView ViewFrom(const Pose& T_cw, const MapPlane& m, const Frame& frame,
                      const Camera& camera) {
  return {ViewMapPlane(m, frame, T_cw, camera), ProjectedBox(m, T_cw, camera)};
}

/// Cost of boxes that do not agree, where both sides have one.
double BoxCost(const Frame& frame, const FramePlane& f, const MapPlane& m, const Box& box_px,
               const AssociationConfig& config) {
  if (!f.detection || m.class_name.empty() || f.class_name.empty()) return 0.0;
  const std::size_t d = Index(*f.detection);
  if (d >= frame.detections.size()) return 0.0;
  return config.iou_weight * (1 - Iou(box_px, frame.detections[d].box_px));
}

/// Whether a frame plane has been seen as a map plane before: the map plane's points cover most
/// of it. It must be a good part of the map plane, too: what once was taken for a piece of it by
/// mistake, as a book on a desk, is small beside it.
bool WasSeen(const PlaneView& view, const FramePlane& f, const AssociationConfig& config) {
  constexpr double kMostOfIt = 0.8;  // of the area; measured: 0.5 costs 0.004 of precision
  return Covered(view, f) > kMostOfIt &&
         view.landed[Index(f.index)] * FragmentRatio(config) > view.expected;
}

PairEvidence Weigh(const Frame& frame, const FramePlane& f, const MapPlane& m,
                   const PlaneComparison& comparison, const MapPlaneView& view,
                   const AssociationConfig& config) {
  PairEvidence pair;
  pair.map_plane = m.id;
  pair.on_trial = m.status == LandmarkStatus::kCandidate;
  pair.overlap = Overlap(view.footprint, f);
  pair.was_seen = WasSeen(view.footprint, f, config);
  if (!view.footprint.landed.empty()) pair.landed = view.footprint.landed[Index(f.index)];
  pair.landed_m2 = pair.landed * view.footprint.cell_m2;
  pair.parameter_cost = comparison.chi2;
  pair.overlap_cost = config.overlap_weight * (1 - pair.overlap);
  pair.class_cost = -2 * std::log(ClassLikelihood(m.class_belief, f.class_name));
  pair.box_cost = BoxCost(frame, f, m, view.box_px, config);

  if (!(pair.overlap > config.min_overlap)) {
    pair.refusal = PairRefusal::kOverlap;
  } else if (!(pair.Cost() < config.max_chi2 + config.overlap_weight)) {
    pair.verdict = PairVerdict::kDoubtful;
    pair.refusal = PairRefusal::kCost;
  } else {
    pair.verdict = PairVerdict::kPossible;
  }
  return pair;
}

/// Of two landmarks that a frame plane could show, it rather shows the one of which more is seen
/// on it: a desk's segment that took in a book is the desk.
void WeighShares(std::vector<PairEvidence>& row, const AssociationConfig& config) {
  double most_m2 = 0.0;
  for (const PairEvidence& pair : row)
    if (pair.verdict == PairVerdict::kPossible) most_m2 = std::max(most_m2, pair.landed_m2);
  for (PairEvidence& pair : row) {
    if (!(pair.landed_m2 > 0.0) || !(most_m2 > pair.landed_m2)) continue;
    pair.share_cost = std::min(2.0 * std::log(most_m2 / pair.landed_m2), config.overlap_weight);
  }
}

}  // namespace

double FragmentRatio(const AssociationConfig& config) {
  return std::exp(0.5 * config.min_margin);  // as likelihoods have that must not be confused
}

PairTable WeighPairs(const Frame& frame, const Map& map, const UncertainPose& pose,
                     const UncertainPose& predicted, const Camera& camera,
                     const AssociationConfig& config, PairRefusals& refused) {
  PairTable pairs(frame.planes.size());
  for (const MapPlane& m : map.planes) {
    if (m.status == LandmarkStatus::kMerged) continue;
    const int links = LinksTo(m, map);
    const UncertainPose drifted = WithDrift(pose, predicted, links);
    std::optional<MapPlaneView> view;  // costs more than the parameters: only where they agree
    for (std::size_t f = 0; f < frame.planes.size(); ++f) {
      const FramePlane& plane = frame.planes[f];
      if (!CanBeMatched(plane)) continue;
      const PlaneComparison comparison = ComparePlanes(plane, m, drifted, config);
      if (!(comparison.angle_rad < config.gates.max_normal_angle_rad)) {  // eq6
        refused.Add(PairRefusal::kNormalAngle);
        continue;
      }
      if (!(comparison.chi2 < config.new_chi2)) {
        refused.Add(PairRefusal::kParameters);
        continue;
      }
      // If the two are one, the camera is where they meet: where the pose is hardly known, that is
      // far from here, and from here the one would hide the other.
      if (std::abs(comparison.offset_m) > HidingMargin_m(plane.centroid_c.z())) {
        const UncertainPose there =
            CorrectPrediction(drifted, frame, map, {{static_cast<int>(f), m.id}}, config);
        pairs[f].push_back(
            Weigh(frame, plane, m, comparison, ViewFrom(there.T_cw, m, frame, camera), config));
      } else {
        if (!view) view = ViewFrom(pose.T_cw, m, frame, camera);
        pairs[f].push_back(Weigh(frame, plane, m, comparison, *view, config));
      }
      pairs[f].back().links = links;
      pairs[f].back().spread_cost = comparison.log_spread;
    }
  }
  for (auto& row : pairs) WeighShares(row, config);
  return pairs;
}

void TestRanks(const Frame& frame, const Map& map, const Pose& T_cw, const Camera& camera,
               const AssociationConfig& config, PairTable& pairs) {
  // A pair that shares most of its footprint is one surface however its points are spread.
  constexpr double kMaxTestedOverlap = 0.6;
  const auto points_c = FeaturesOnPlanes(frame, T_cw, camera);
  std::map<int, std::vector<Eigen::Vector3d>> points_w;  // by map plane
  for (std::size_t f = 0; f < pairs.size(); ++f) {
    for (PairEvidence& pair : pairs[f]) {
      if (pair.verdict != PairVerdict::kPossible || pair.overlap > kMaxTestedOverlap) continue;
      const MapPlane& m = map.planes.At(pair.map_plane);
      const auto [seen, first] = points_w.try_emplace(pair.map_plane);
      if (first) seen->second = VisibleMapPoints(m, map, frame, T_cw, camera);
      const auto p = TestPlaneRanks(points_c[f], seen->second, PlaneAxes(m.pi_w, seen->second),
                                    config.min_rank_points);
      if (!p || *p >= config.rank_alpha) continue;
      pair.verdict = PairVerdict::kDoubtful;
      pair.refusal = PairRefusal::kRankTest;
    }
  }
}

std::vector<std::pair<int, int>> PairsBeyondDoubt(const Frame& frame, const PairTable& pairs) {
  constexpr double kMinOverlap = 0.5;  // share of the smaller footprint: most of it
  std::vector<std::pair<int, int>> certain;
  for (std::size_t f = 0; f < pairs.size(); ++f) {
    if (frame.planes[f].bad) continue;
    // The landmarks in question for this frame plane: exactly one, and possible.
    const PairEvidence* only = nullptr;
    int competitors = 0;
    for (const PairEvidence& pair : pairs[f]) {
      if (pair.on_trial || pair.verdict == PairVerdict::kRefused) continue;
      only = &pair;
      ++competitors;
    }
    if (competitors != 1 || only->verdict != PairVerdict::kPossible) continue;
    if (only->overlap > kMinOverlap && only->links == 0) {
      certain.emplace_back(static_cast<int>(f), only->map_plane);
    }
  }
  return certain;
}

}  // namespace slam
