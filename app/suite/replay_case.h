#pragma once

#include <filesystem>

#include "app/suite/run_case.h"

namespace app {

/// Runs a case again where its output is seen, without limits; the run stays in `folder`/replay.
/// @returns the exit code of the command that ended it; 128 + signal when one did
int ReplayCase(const SuiteCase& one, const SuiteProgram& program,
               const std::filesystem::path& folder, bool quiet);

}  // namespace app
