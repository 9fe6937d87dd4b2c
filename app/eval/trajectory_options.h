#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "eval/trajectory/compare_trajectories.h"

namespace app {

/// `pas eval --trajectory`: bare files of poses against one of truth.
struct TrajectoryOptions {
  std::vector<std::string> files;
  eval::ComparisonRules rules;  ///< what --delta and --all-pairs say comes last, in RulesOf
  std::string delta = "1f";
  bool all_pairs = false;
};

void AddTrajectoryOptions(CLI::App& command, TrajectoryOptions& options);

/// @throws InputError for a --delta that is none
eval::ComparisonRules RulesOf(const TrajectoryOptions& options);

}  // namespace app
