#pragma once

#include <optional>
#include <set>

#include "eval/formats/run.h"
#include "eval/planes/association.h"
#include "eval/planes/clear_score.h"
#include "eval/planes/corners.h"
#include "eval/planes/hota_score.h"
#include "eval/planes/identity_score.h"
#include "eval/planes/map_score.h"
#include "eval/planes/segmentation_score.h"
#include "eval/trajectory/score_trajectory.h"

namespace eval {

/// Means per frame of Hoover's counts, panoptic quality and pixels over all frames.
struct RegionScore {
  double truth = 0.0, machine = 0.0;
  double correct = 0.0, over = 0.0, under = 0.0, missed = 0.0, noise = 0.0;
  PanopticCounts panoptic;
  double pixel_precision = 0.0;  ///< pixels of trusted planes that show the plane's own truth
  double pixel_recall = 0.0;     ///< pixels of true planes that count, so covered
};

/// The groups `extraction`, `vertices`, `association` and `map` of metrics.json.
struct PlaneScore {
  int frames = 0;          ///< frames with truth
  bool by_pixels = false;  ///< truth of a frame plane by its pixels (else by geometry)
  std::optional<RegionScore> regions;  ///< only by pixels
  std::optional<Spread> normal_deg;    ///< trusted frame planes against their truth
  std::optional<Spread> offset_mm;     ///< at the foot of the patch's centroid on its plane
  CornerCounts corners;
  AssociationScore association;
  ClearScore clear;
  IdentityScore identity;
  HotaScore hota;
  std::optional<MapScore> map;  ///< empty without map.json
};

/// Scores the planes of a run. Every frame of the sequence with a true pose counts; one that
/// the run says nothing about shows no planes.
/// @returns nothing if the sequence has no gt/scene.json or the run no frame_planes.jsonl
/// @throws InputError for images that cannot be read or differ in size
std::optional<PlaneScore> ScorePlanes(const Run& run, const Sequence& sequence,
                                      const TrajectoryScore& trajectory);

}  // namespace eval
