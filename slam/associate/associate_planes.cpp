#include "slam/associate/associate_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "slam/associate/correct_prediction.h"
#include "slam/associate/frame_relations.h"
#include "slam/associate/nearest_rules.h"
#include "slam/associate/pair_evidence.h"
#include "slam/associate/plane_assignment.h"
#include "slam/base/index.h"
#include "slam/model/class_belief.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

/// Two surfaces of the map that can be one surface found twice.
bool AreDuplicates(const MapPlane& one, const MapPlane& other,
                   const AssociationConfig& config) {
  return !StepLiesBetween(one, other) &&
         SameClassOdds(one.class_belief, other.class_belief) > config.min_class_odds &&
         ComparePlanes(one, other).chi2 < config.max_chi2;
}

/// Ids of map planes that one frame plane could show both of, and that can be duplicates.
std::set<std::pair<int, int>> DuplicatesAmong(const PairTable& pairs, const Map& map,
                                              const AssociationConfig& config) {
  // Pairs of map planes in question for one frame plane; then those that fit each other.
  std::set<std::pair<int, int>> together, duplicates;
  for (const auto& row : pairs) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      for (std::size_t k = i + 1; k < row.size(); ++k) {
        if (row[i].verdict == PairVerdict::kPossible &&
            row[k].verdict == PairVerdict::kPossible)
          together.emplace(row[i].map_plane, row[k].map_plane);
      }
    }
  }
  for (const auto& [m, n] : together) {
    if (AreDuplicates(map.planes.At(m), map.planes.At(n), config)) duplicates.emplace(m, n);
  }
  return duplicates;
}

/// A candidate is excluded where a landmark is in doubt, or where it can be that landmark found
/// twice.
bool IsExcluded(const PairEvidence& candidate, const std::vector<PairEvidence>& row,
                const std::set<std::pair<int, int>>& duplicates) {
  return std::any_of(row.begin(), row.end(), [&](const PairEvidence& other) {
    return !other.on_trial &&
           (other.verdict == PairVerdict::kDoubtful ||
            duplicates.contains(std::minmax(candidate.map_plane, other.map_plane)));
  });
}

/// What the assignment may choose from.
std::vector<AdmissiblePair> AdmissiblePairs(const PairTable& pairs,
                                            const std::set<std::pair<int, int>>& duplicates) {
  std::vector<AdmissiblePair> admissible;
  for (std::size_t f = 0; f < pairs.size(); ++f) {
    for (const PairEvidence& pair : pairs[f]) {
      if (pair.verdict != PairVerdict::kPossible) continue;
      if (pair.on_trial && IsExcluded(pair, pairs[f], duplicates)) continue;
      admissible.push_back(
          {static_cast<int>(f), pair.map_plane, pair.Cost(), pair.on_trial, pair.was_seen});
    }
  }
  return admissible;
}

/// The likeliest of the possible pairs of one frame plane, or null.
const PairEvidence* BestPair(const std::vector<PairEvidence>& row) {
  const PairEvidence* best = nullptr;
  for (const PairEvidence& pair : row) {
    if (pair.verdict != PairVerdict::kPossible) continue;
    if (best == nullptr || pair.Cost() < best->Cost()) best = &pair;
  }
  return best;
}

/// Most of what is seen of a map plane lies on the frame plane that shows it. Where that one has
/// nowhere better to go, fragments beside it that are no pieces of the same surface are refused,
/// however well their parameters fit: the smaller a patch, the more its parameters fit.
void RefuseFragments(const PieceTable& pieces, const AssociationConfig& config,
                     PairTable& pairs) {
  const double max_ratio = FragmentRatio(config);
  std::vector<const PairEvidence*> best;
  for (const auto& row : pairs) best.push_back(BestPair(row));
  std::vector<PairEvidence*> fragments;
  for (std::size_t f = 0; f < pairs.size(); ++f) {
    for (PairEvidence& pair : pairs[f]) {
      if (pair.verdict != PairVerdict::kPossible) continue;
      for (std::size_t g = 0; g < pairs.size(); ++g) {
        if (g == f || pieces[f][g] == Pieces::kOfOne || best[g] == nullptr) continue;
        if (best[g]->map_plane == pair.map_plane && best[g]->landed > max_ratio * pair.landed)
          fragments.push_back(&pair);
      }
    }
  }
  for (PairEvidence* pair : fragments) {
    pair->verdict = PairVerdict::kDoubtful;
    pair->refusal = PairRefusal::kOverlap;
  }
}

MatchReason ReasonOf(PairRefusal refusal) {
  switch (refusal) {
    case PairRefusal::kOverlap:
      return MatchReason::kOverlap;
    case PairRefusal::kRankTest:
      return MatchReason::kRankTest;
    default:
      return MatchReason::kParameters;
  }
}

/// The cue that told the match from the runner-up: the one that refused it, or else the one by
/// which it is dearest.
MatchReason WhatDecided(const std::vector<PairEvidence>& row, const PairEvidence& match,
                        const std::set<std::pair<int, int>>& duplicates) {
  // The cheapest other pair, duplicates of the match apart.
  const PairEvidence* runner_up = nullptr;
  for (const PairEvidence& pair : row) {
    if (pair.map_plane == match.map_plane) continue;
    if (duplicates.contains(std::minmax(pair.map_plane, match.map_plane))) continue;
    if (runner_up == nullptr || pair.Cost() < runner_up->Cost()) runner_up = &pair;
  }
  if (runner_up == nullptr) return MatchReason::kParameters;
  if (runner_up->verdict != PairVerdict::kPossible &&
      runner_up->refusal != PairRefusal::kCost) {
    return ReasonOf(runner_up->refusal);
  }
  // It was possible: the cue that made it dearest.
  const std::array<std::pair<double, MatchReason>, 4> dearer = {
      {{runner_up->parameter_cost + runner_up->spread_cost - match.parameter_cost -
            match.spread_cost,
        MatchReason::kParameters},
       {runner_up->overlap_cost + runner_up->share_cost - match.overlap_cost - match.share_cost,
        MatchReason::kOverlap},
       {runner_up->class_cost - match.class_cost, MatchReason::kClass},
       {runner_up->box_cost - match.box_cost, MatchReason::kBox}}};
  return std::max_element(dearer.begin(), dearer.end(),
                          [](const auto& a, const auto& b) { return a.first < b.first; })
      ->second;
}

/// One plane's decision from what the assignment gave it.
PlaneMatch Decide(const std::vector<PairEvidence>& row, int assigned,
                  const std::set<std::pair<int, int>>& duplicates) {
  if (assigned >= 0) {
    const PairEvidence& pair = *std::find_if(
        row.begin(), row.end(),
        [&](const PairEvidence& candidate) { return candidate.map_plane == assigned; });
    return {pair.on_trial ? PlaneDecision::kTrial : PlaneDecision::kMatched, assigned,
            WhatDecided(row, pair, duplicates)};
  }
  PlaneMatch none;
  const bool in_doubt = std::any_of(row.begin(), row.end(), [](const PairEvidence& pair) {
    return pair.verdict == PairVerdict::kDoubtful;
  });
  if (assigned == PlaneAssignment::kAmbiguous || in_doubt) {
    none.reason = MatchReason::kAmbiguous;
  }
  return none;
}

PlaneAssociation IntegratedRule(const Frame& frame, const Map& map, const Camera& camera,
                                const AssociationConfig& config) {
  // What fits beyond doubt corrects the predicted pose, and all pairs are weighed again there.
  PlaneAssociation out;
  PairRefusals before_correction;  // not counted: these pairs are asked again
  const UncertainPose predicted = PredictedPose(frame);
  PairTable pairs =
      WeighPairs(frame, map, predicted, predicted, camera, config, before_correction);
  const UncertainPose pose =
      CorrectPrediction(predicted, frame, map, PairsBeyondDoubt(frame, pairs), config);
  pairs = WeighPairs(frame, map, pose, predicted, camera, config, out.refused);
  TestRanks(frame, map, pose.T_cw, camera, config, pairs);

  // All planes of the frame are assigned together; what refused a pair is counted.
  FrameRelations relations = RelateFramePlanes(frame, camera, config);
  out.steps = std::move(relations.steps);
  RefuseFragments(relations.pieces, config, pairs);
  const auto duplicates = DuplicatesAmong(pairs, map, config);
  const PlaneAssignment assignment =
      AssignPlanes(static_cast<int>(frame.planes.size()), AdmissiblePairs(pairs, duplicates),
                   {relations.pieces, duplicates}, config.min_margin);
  for (std::size_t f = 0; f < pairs.size(); ++f) {
    out.matches.push_back(Decide(pairs[f], assignment.map_plane[f], duplicates));
    for (const PairEvidence& pair : pairs[f]) {
      if (pair.verdict != PairVerdict::kPossible) out.refused.Add(pair.refusal);
    }
  }
  return out;
}

/// What common systems do: of the landmarks that pass the rule's bounds the nearest, of the
/// candidates where there is none.
PlaneAssociation NearestRule(const Frame& frame, const Map& map,
                             const AssociationConfig& config) {
  PlaneAssociation out;
  out.matches.resize(frame.planes.size());
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    if (frame.planes[f].bad) continue;
    constexpr double kNone_m = std::numeric_limits<double>::infinity();
    double nearest_m = kNone_m, nearest_on_trial_m = kNone_m;
    PlaneMatch landmark, candidate;
    for (const MapPlane& m : map.planes) {
      if (m.status == LandmarkStatus::kMerged) continue;
      const auto distance_m =
          TestNearness(frame.planes[f], m, frame.T_cw, config.rule, config.gates);
      if (!distance_m) {
        out.refused.Add(distance_m.error());
        continue;
      }
      const bool on_trial = m.status == LandmarkStatus::kCandidate;
      double& nearest = on_trial ? nearest_on_trial_m : nearest_m;
      if (!(distance_m.value() < nearest)) continue;
      nearest = distance_m.value();
      (on_trial ? candidate : landmark) = {
          on_trial ? PlaneDecision::kTrial : PlaneDecision::kMatched, m.id,
          MatchReason::kParameters};
    }
    out.matches[f] = landmark.map_plane != kNone ? landmark : candidate;
  }
  return out;
}

}  // namespace

PlaneAssociation AssociatePlanes(const Frame& frame, const Map& map, const Camera& camera,
                                 const AssociationConfig& config) {
  return config.rule == AssociationRule::kIntegrated
             ? IntegratedRule(frame, map, camera, config)
             : NearestRule(frame, map, config);
}

}  // namespace slam
