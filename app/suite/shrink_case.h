#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/suite/run_case.h"

namespace app {

/// What makes a case a failure worth shrinking.
struct CaseFailure {
  CaseStatus status = CaseStatus::kFinished;
  std::string message;              ///< of a case that is not done, without its digits
  std::vector<std::string> beyond;  ///< of one that is: figures beyond their bounds
};

/// A figure of a case that is worse than the baseline's.
struct WorseFigure {
  std::string figure;
  double before = 0.0, now = 0.0;
};

/// Of the figures that the gate compares, times left out, the one whose harm is most beyond what
/// matters. @returns nothing when none is, or a figure is undefined, which no bound can tell
std::optional<WorseFigure> FindWorseFigure(const eval::Figures& before,
                                           const eval::Figures& now);

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
  std::string failure;          ///< how the whole case fails, in words
  std::filesystem::path scene;  ///< what is left of its scene
  std::filesystem::path suite;  ///< a suite of this one case, for tests/regressions
};

/// Looks for a smaller case that fails alike: fewer frames, smaller images, fewer objects, each
/// taken away while the failure stays. Writes its scene and a suite into `folder`/shrunk.
/// A case that is done and within its bounds fails by the figure that is worse than the
/// baseline's. A smaller one fails alike while that figure is within half of the change of the
/// whole case's: on its way back to the baseline's value it is then no failure, and beyond it
/// another one, as images of half the size make larger errors by themselves.
/// @param suite   that the case is of
/// @param before  figures of the case in the baseline; null where there are none
/// @throws InputError when the case does not fail, or is of a recording
ShrunkCase ShrinkCase(const SuiteCase& one, const SuiteFile& suite, const SuiteProgram& program,
                      const std::filesystem::path& folder, const eval::Figures* before,
                      const std::function<bool()>& stop);

}  // namespace app
