#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "eval/trajectory/compare_trajectories.h"

namespace eval {

/// An estimate that was compared with the truth.
struct ComparedTrajectory {
  std::string file;  ///< as it was named
  PoseFileKind kind = PoseFileKind::kTum;
  TrajectoryComparison score;
};

/// The document that `pas eval --trajectory -o` writes, format "pas-trajectories/1": an object for
/// each estimate, with what is not defined null and the reason in its `reasons`.
nlohmann::ordered_json TrajectoriesJson(const std::vector<ComparedTrajectory>& compared,
                                        const std::string& truth, const ComparisonRules& rules);

/// A row for each estimate, under one header that says the rules.
std::string TrajectoriesTable(const std::vector<ComparedTrajectory>& compared,
                              const std::string& truth, const ComparisonRules& rules);

/// The rules as options are written: "se3", "1f", "xy" (empty for none).
const char* NameOf(AlignMode mode);
std::string TextOf(const PoseDelta& delta);
const char* NameOf(ProjectionPlane plane);

}  // namespace eval
