#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/formats/run/run_map.h"
#include "eval/formats/sequence/scene_truth.h"
#include "eval/planes/plane_decisions.h"
#include "eval/trajectory/alignment.h"

namespace eval {

/// What went wrong at one place of a run.
enum class EventKind {
  kWrong,       ///< a frame plane was put on a map plane that another surface made
  kMissed,      ///< it made a new map plane although its surface had one
  kNoDecision,  ///< a large surface that has a map plane got no decision
  kAmbiguous,   ///< a frame plane of a surface that has one was left as ambiguous
  kMerge,       ///< a map plane holds two surfaces; sums up wrong decisions
  kSplit,       ///< a surface has two map planes; sums up the decisions for the lesser one
  kSplitOff,    ///< the run itself split a map plane; sums up the decisions for the new one
  kLost,        ///< the camera lost its way
};
const char* NameOf(EventKind kind);

/// One of them. Planes are ids of the truth (0: none that is scored) and of the run's final map.
struct RunEvent {
  EventKind kind = EventKind::kWrong;
  int frame = 0;  ///< in the sequence, from 0; the first one
  double stamp_s = 0.0;
  int frames = 1;  ///< that it lasts, or that it sums up
  std::optional<int> truth, other_truth;
  std::optional<int> map_plane;        ///< that was given
  std::optional<int> right_map_plane;  ///< that the truth has
  std::string cue;                     ///< what settled it, as the run says; may be empty
  std::optional<long long> pixels;  ///< of the frame plane, or of the surface; sums of frames
  /// From the map plane that was given to the true plane: root mean square over the true plane's
  /// corners; for what shows no scored plane from the middle of the patch.
  std::optional<double> distance_mm;
  /// Pixels times millimetres, summed over frames; nothing where no plane was given, or where the
  /// map or its place in the world of the truth is not known.
  std::optional<double> harm_px_mm;
};

/// What decisions are judged by.
struct EventWorld {
  const std::vector<RunMapPlane>& map;
  const SceneTruth& scene;
  const std::optional<Alignment>& gauge;  ///< world of the run to world of the truth
};

/// Wrong and missed decisions, surfaces without a decision, ambiguous frame planes but those that
/// such a surface is judged by, merges and splits, and the map planes that the run split.
std::vector<RunEvent> FindPlaneEvents(const DecisionHistory& history,
                                      const UndecidedSurfaces& undecided,
                                      const std::vector<AmbiguousPlane>& ambiguous,
                                      const EventWorld& world);

/// The most harmful first; those whose harm is not known behind them, by pixels, then by frame.
void SortByHarm(std::vector<RunEvent>& events);

}  // namespace eval
