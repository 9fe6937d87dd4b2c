#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/planes/score_planes.h"
#include "eval/trajectory/score_trajectory.h"

namespace eval {

/// Time of one module, milliseconds per frame; an empty cell of timing.csv does not count, a 0 does.
struct ModuleTime {
  std::string module;
  double mean = 0.0, median = 0.0, p95 = 0.0;
};

/// The group `timing_ms` of metrics.json.
struct TimingScore {
  std::vector<ModuleTime> modules;  ///< in the order of timing.csv
  std::optional<double> fps;        ///< 1000 / mean of `mt`, the whole tracking
  std::optional<double> peak_rss_mb;
};

/// All that can be said about a run; a group that cannot be computed is empty.
struct Evaluation {
  TrajectoryScore trajectory;  ///< without groundtruth.txt there are counts and no errors
  std::optional<PlaneScore> planes;
  /// Groups of metrics.json of which the run has planes and the truth tells none, and why.
  std::vector<std::string> groups_without_truth;
  std::string no_planes;
  std::optional<TimingScore> timing;
  bool interrupted = false;              ///< the run ended before the sequence did
  std::vector<Fault> run_warnings;       ///< what to know of the run beside its figures
  std::vector<Fault> sequence_warnings;  ///< and of the sequence
};

/// Scores a run against a sequence. @throws InputError as the readers and scorers do.
Evaluation Evaluate(const Run& run, const Sequence& sequence);

/// Label images alone against the planes that the sequence shows.
struct LabelEvaluation {
  PlaneScore planes;                     ///< of which the regions are scored
  std::vector<Fault> label_warnings;     ///< frames without an image
  std::vector<Fault> sequence_warnings;  ///< as of a run
};

/// @param labels  as RunOfLabels reads them
/// @throws InputError for a sequence without gt/scene.json, groundtruth.txt and gt/plane_id, when no
///   image is named after a frame, and as the readers do
LabelEvaluation EvaluateLabels(const Run& labels, const Sequence& sequence);

}  // namespace eval
