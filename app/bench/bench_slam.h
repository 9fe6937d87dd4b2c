#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/trajectory/score_trajectory.h"
#include "slam/run/config.h"

namespace app {

/// How sequences are played to the estimator.
struct BenchOptions {
  std::string variant = "points";
  slam::Config config;
  int threads = 1;
  int black_every = 0, black_frames = 12;  ///< the lens is covered; 0: never
  int blind_frames = 0;                    ///< so many of these have no depth either
  std::string then;  ///< another sequence that is shown in the end; empty: none
  int laps = 1;      ///< to and fro over the sequence so often; odd laps run backwards
};

/// A time without pose, from when the camera sees again what it saw while it was tracked.
struct Comeback {
  int waited = 0;      ///< frames until it was found; -1: never
  double error_m = 0;  ///< error of the first pose, the run laid on the truth
};

/// What one sequence came to.
struct BenchRow {
  std::string name;
  int frames = 0, tracked = 0;
  eval::TrajectoryScore score;  ///< empty with laps: the truth knows one only
  int keyframes = 0, points = 0;
  double end_error_m = 0;  ///< error of the last pose, the first ones laid on the truth
  std::vector<std::vector<double>> modules_ms;
  int elsewhere = 0, taken = 0;  ///< frames of another sequence, and those that got a pose
  double run_ms = 0;             ///< of the whole run by the clock, a frame: files too
  double kib_a_frame = 0;        ///< resident memory, over the second half
  std::vector<Comeback> comebacks;
};

/// Runs pas slam on a sequence folder, in a folder that is removed again.
BenchRow MeasureSlam(const std::string& sequence, const BenchOptions& options);

}  // namespace app
