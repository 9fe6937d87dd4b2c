#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "app/suite/suite_cases.h"
#include "eval/regression/gated_metrics.h"

namespace app {

/// What became of a case.
enum class CaseStatus { kFinished, kFailed, kCrashed, kTimedOut, kOutOfMemory, kStopped };

/// "done", "failed", "crashed", "timeout", "memory", "stopped", in that order.
const char* NameOf(CaseStatus status);

/// A case that has been run. Everything but `times` depends on its inputs alone.
struct CaseResult {
  CaseStatus status = CaseStatus::kFinished;
  std::string message;    ///< why it is not done, one line
  eval::Figures figures;  ///< JSON pointer into metrics.json -> value
  /// Seconds of rendering, slam and evaluation, peak_mb, and the times of metrics.json.
  eval::Figures times;
};

/// Keys of `times`.
inline constexpr const char* kRenderingTime = "rendering_s";
inline constexpr const char* kSlamTime = "slam_s";
inline constexpr const char* kEvaluationTime = "evaluation_s";
inline constexpr const char* kPeakMemory = "peak_mb";

/// The commands of a case, to be run from the results folder; the run is put into `run`.
std::vector<std::vector<std::string>> CommandsOf(const SuiteCase& one,
                                                 const std::string& program,
                                                 const std::string& run);

/// They as one line of a shell, joined by &&.
std::string CommandLines(const std::vector<std::vector<std::string>>& commands);

/// The message of a case that was ended at a limit (kTimedOut, kOutOfMemory).
std::string LimitMessage(CaseStatus status, const SuiteLimits& limits);

/// Runs a case in processes of its own. Its run folder is gone afterwards.
/// @param folder  results folder
/// @param stop    true ends it; the status is kStopped then
CaseResult RunCase(const SuiteCase& one, const SuiteProgram& program, const SuiteLimits& limits,
                   const std::filesystem::path& folder, const std::function<bool()>& stop);

}  // namespace app
