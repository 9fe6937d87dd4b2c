#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eval/plot/axes.h"
#include "eval/plot/figure.h"
#include "eval/report/evaluate.h"

namespace eval {

/// A run with the name by which plots call it.
struct PlottedRun {
  std::string name;
  Evaluation evaluation;
};

/// Each gives the files of one plot, or none when no run has what it shows.

/// Paths from above (x, y of the world of the truth) over the true ones. Runs of several sequences
/// each bring their own truth.
std::vector<PlotFile> PlotTrajectories(const std::vector<PlottedRun>& runs);
/// Position errors over the time since the first pose, and the share of poses below each error.
std::vector<PlotFile> PlotErrors(const std::vector<PlottedRun>& runs);
/// Precision and recall of the association on tops of regular objects, over the height of their step.
std::vector<PlotFile> PlotSteps(const std::vector<PlottedRun>& runs);
/// Mean time of each module, a whisker up to the 95th percentile.
std::vector<PlotFile> PlotTimes(const std::vector<PlottedRun>& runs);

/// A point for each pose of the run that `point_of` gives one, and a gap where the camera was lost.
std::vector<PlotPoint> WithGaps(
    const PlottedRun& run,
    const std::function<std::optional<PlotPoint>(const PoseError&)>& point_of);

/// Names and styles of the runs, for a legend.
std::vector<LegendEntry> LegendOf(const std::vector<PlottedRun>& runs);

}  // namespace eval
