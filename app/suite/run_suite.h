#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "app/suite/results.h"

namespace app {

/// How the cases of a suite are run.
struct SuiteRunOptions {
  std::filesystem::path folder;  ///< of the results
  SuiteProgram program;
  std::string version;  ///< of this program, for the rows
  SuiteLimits limits;
  int jobs = 1;
  bool quiet = false;
  bool retry_failed = false;  ///< run cases again that are not done, whatever the reason
  std::function<bool()> stop;
};

/// Runs the cases whose results are not there yet, are of other inputs, or were ended at other
/// limits, `jobs` at a time, and puts each into the results when it ends. Rows do not depend on
/// `jobs`, but for times.
/// @returns whether it was stopped before the end; what was done is kept
/// @throws InputError, also when the program was replaced meanwhile
bool RunCases(const std::vector<SuiteCase>& cases, const SuiteRunOptions& options,
              Results& results);

}  // namespace app
