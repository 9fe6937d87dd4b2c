#pragma once

#include <vector>

#include "eval/formats/sequence/scene_truth.h"
#include "eval/planes/plane_decisions.h"

namespace eval {

/// Height of a top face above the highest other one right below its middle, metres; 0 if there is
/// none.
double StepOf(const TruthPlane& top, const SceneTruth& scene);

/// Whether a plane looks up, as tops do. World frame, z up.
bool LooksUp(const TruthPlane& plane);

/// Tops of regular objects whose step is in one class of heights.
struct StepScore {
  double min_mm = 0.0, max_mm = 0.0;  ///< of the class; the last one has no end
  int seen = 0;                       ///< tops in frames in which they count
  int right = 0;  ///< those of them with a frame plane that was put on a map plane of their own
  /// Frame planes on the tops, in all frames, that were put on a map plane: of their own, or of
  /// another surface.
  int right_planes = 0, wrong_planes = 0;
};

/// By rising height, classes without a top left out.
std::vector<StepScore> ScoreSteps(const DecisionHistory& history, const SceneTruth& scene);

}  // namespace eval
