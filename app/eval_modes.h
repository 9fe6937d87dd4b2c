#pragma once

#include <string>

#include "app/app.h"
#include "app/surfaces_option.h"
#include "app/trajectory_options.h"

namespace app {

/// What `pas eval` is told.
struct EvalOptions {
  std::string run;
  std::string truth;
  std::string output;
  bool force = false;
  SurfacesOption surfaces;
  TrajectoryOptions trajectory;
};

/// Files of poses against one of truth. @returns the exit code
int EvalTrajectories(const EvalOptions& options, const Globals& globals);

}  // namespace app
