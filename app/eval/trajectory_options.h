#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "eval/trajectory/compare_trajectories.h"

namespace app {

/// `pas eval --trajectory`: bare files of poses against one of truth.
struct TrajectoryOptions {
  std::vector<std::string> files;
  std::string align = "se3", delta = "1f", plane;
  double max_difference_s = eval::kMaxStampDifference_s;
  bool all_pairs = false, pairs_from_truth = false;
};

void AddTrajectoryOptions(CLI::App& command, TrajectoryOptions& options);

/// @throws InputError for a --delta that is none
eval::ComparisonRules RulesOf(const TrajectoryOptions& options);

}  // namespace app
