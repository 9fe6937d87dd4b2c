#pragma once

#include <optional>
#include <set>
#include <string>

#include "eval/formats/run/run.h"
#include "eval/planes/association.h"
#include "eval/planes/clear_score.h"
#include "eval/planes/corners.h"
#include "eval/planes/hota_score.h"
#include "eval/planes/identity_score.h"
#include "eval/planes/map_score.h"
#include "eval/planes/plane_events.h"
#include "eval/planes/region_score.h"
#include "eval/planes/step_scores.h"
#include "eval/trajectory/score_trajectory.h"

namespace eval {

/// What one frame shows.
struct FrameScore {
  int frame = 0;                       ///< in the sequence, from 0
  int true_planes = 0;                 ///< that count
  std::optional<HooverScore> regions;  ///< only by pixels
};

/// The groups `extraction`, `vertices`, `association` and `map` of metrics.json.
struct PlaneScore {
  int frames = 0;  ///< frames with truth
  /// The run has frame planes; else there are regions and the map at most.
  bool from_frame_planes = true;
  bool by_pixels = false;  ///< truth of a frame plane by its pixels (else by geometry)
  std::optional<RegionScore> regions;  ///< only by pixels
  std::optional<Spread>
      normal_deg;  ///< trusted frame planes against their truth, where that counts
  std::optional<Spread> offset_mm;  ///< at the foot of the patch's centroid on its plane
  CornerCounts corners;
  AssociationScore association;
  UndecidedSurfaces undecided;
  std::vector<AmbiguousPlane> ambiguous;  ///< of surfaces in the map; unknown without `by`
  ClearScore clear;
  IdentityScore identity;
  HotaScore hota;
  std::optional<MapScore> map;  ///< empty without map.json
  DecisionHistory history;
  std::vector<RunEvent> events;      ///< what went wrong, the most harmful first
  std::vector<StepScore> steps;      ///< tops of regular objects by the height of their step
  std::vector<FrameScore> by_frame;  ///< frames with a true pose
};

/// Why no plane of any run can be scored though the sequence has gt/scene.json: it does not tell
/// which planes its frames show. Empty where it does, and without gt/scene.json.
std::string WhyNoPlaneScore(const Sequence& sequence);

/// Scores the planes of a run. Every frame of the sequence with a true pose counts; one that
/// the run says nothing about shows no planes.
/// @returns nothing if the sequence has no gt/scene.json or does not tell what its frames show, or
///   the run neither frame_planes.jsonl nor map.json nor label images
/// @throws InputError for images that cannot be read or differ in size
std::optional<PlaneScore> ScorePlanes(const Run& run, const Sequence& sequence,
                                      const TrajectoryScore& trajectory);

}  // namespace eval
