#pragma once

#include <string>

namespace app {

/// What `pas suite SUITE.yaml` is told; texts are empty where it is told nothing.
struct SuiteArguments {
  std::string suite, output, recordings, program, shard, baseline, accept, replay, shrink;
  int jobs = 0;  ///< cases at a time; 0: one a core
  bool retry_failed = false;
};

/// Runs a suite, and what is asked for beside: its gate, a new baseline, one case again or made smaller.
/// @returns the exit code
/// @throws InputError
int CallSuite(const SuiteArguments& arguments, bool quiet);

}  // namespace app
