#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "app/suite/run_case.h"

namespace app {

/// What makes a case a failure worth shrinking.
struct CaseFailure {
  CaseStatus status = CaseStatus::kFinished;
  std::string message;              ///< of a case that is not done, without its digits
  std::vector<std::string> beyond;  ///< of one that is: figures beyond their bounds
};

/// @param worst  by figure: the bounds of the suite's gate
/// @returns a failure with status kFinished and no figures for a case that is fine
CaseFailure FailureOf(const CaseResult& result, const std::map<std::string, double>& worst);

/// Whether the second fails as the first does: with the same message, or with one of its figures
/// beyond the bound.
bool FailsAlike(const CaseFailure& first, const CaseFailure& second);

/// What is left of a case.
struct ShrunkCase {
  int frames = 0, width = 0, height = 0;
  std::size_t objects = 0;
  int runs = 0;                 ///< that it took
  std::filesystem::path scene;  ///< what is left of its scene
  std::filesystem::path suite;  ///< a suite of this one case, for tests/regressions
};

/// Looks for a smaller case that fails alike: fewer frames, smaller images, fewer objects, each
/// taken away while the failure stays. Writes its scene and a suite into `folder`/shrunk.
/// @param suite  that the case is of
/// @throws InputError when the case does not fail, or is of a recording
ShrunkCase ShrinkCase(const SuiteCase& one, const SuiteFile& suite, const SuiteProgram& program,
                      const std::filesystem::path& folder, const std::function<bool()>& stop);

}  // namespace app
