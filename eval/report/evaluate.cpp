#include "eval/report/evaluate.h"

#include <cmath>

namespace eval {
namespace {

std::optional<TimingScore> ScoreTiming(const Run& run) {
  if (!run.timing) return std::nullopt;
  TimingScore score;
  for (std::size_t column = 0; column < run.timing->modules.size(); ++column) {
    std::vector<double> times_ms;
    for (const std::vector<double>& row : run.timing->rows_ms) {
      if (std::isfinite(row[column])) times_ms.push_back(row[column]);
    }
    const auto described = Describe(times_ms);
    if (!described) continue;
    const std::string& module = run.timing->modules[column];
    score.modules.push_back(
        {module, described->mean, described->median, Quantile(times_ms, 0.95)});
    if (module == "mt" && described->mean > 0.0) score.fps = 1000.0 / described->mean;
  }
  score.peak_rss_mb = run.info.peak_memory_mb;
  return score;
}

}  // namespace

Evaluation Evaluate(const Run& run, const Sequence& sequence) {
  Evaluation evaluation;
  const TrajectoryScore trajectory = ScoreTrajectory(run, sequence);
  evaluation.frames = trajectory.frames;
  evaluation.tracked = trajectory.tracked;
  if (sequence.groundtruth) evaluation.trajectory = trajectory;
  evaluation.planes = ScorePlanes(run, sequence, trajectory);
  evaluation.timing = ScoreTiming(run);
  return evaluation;
}

}  // namespace eval
