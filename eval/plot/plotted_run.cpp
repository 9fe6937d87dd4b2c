#include "eval/plot/plotted_run.h"

#include <limits>

#include "eval/plot/axes.h"

namespace eval {

std::vector<PlotPoint> WithGaps(
    const PlottedRun& run,
    const std::function<std::optional<PlotPoint>(const PoseError&)>& point_of) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const auto& poses = run.evaluation.trajectory.errors;
  std::vector<double> stamps_s;
  stamps_s.reserve(poses.size());
  for (const PoseError& pose : poses) stamps_s.push_back(pose.stamp_s);
  const double gap_s = 2.5 * MedianStep(stamps_s);  // two frames were left out
  std::vector<PlotPoint> points;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::optional<PlotPoint> point = point_of(poses[i]);
    if (!point) continue;
    if (i > 0 && stamps_s[i] - stamps_s[i - 1] > gap_s) points.push_back({kUnknown, kUnknown});
    points.push_back(*point);
  }
  return points;
}

std::vector<LegendEntry> LegendOf(const std::vector<PlottedRun>& runs) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    entries.push_back({runs[i].name, StyleOfSeries(i)});
  }
  return entries;
}

}  // namespace eval
