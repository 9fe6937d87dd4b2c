#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/app.h"
#include "app/eval/trajectory_options.h"
#include "app/options/surfaces_option.h"
#include "eval/formats/folder.h"

namespace app {

/// What `pas eval` is told.
struct EvalOptions {
  std::string run;
  std::string truth;
  std::string output;
  bool force = false;
  SurfacesOption surfaces;
  TrajectoryOptions trajectory;
  std::string segmentation;    ///< folder of label images instead of a run
  std::string frames, events;  ///< files to write, empty for none
};

/// Files of poses against one of truth. @returns the exit code
int EvalTrajectories(const EvalOptions& options, const Globals& globals);

/// A folder of label images against a sequence. @returns the exit code
int EvalLabels(const EvalOptions& options, const Globals& globals);

/// One line on stderr for each kind of fault that the figures can live with.
void PrintWarnings(const std::vector<eval::Fault>& faults, const std::filesystem::path& folder);

}  // namespace app
