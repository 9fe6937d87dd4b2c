#include <algorithm>

#include "eval/plot/axes.h"
#include "eval/plot/plotted_run.h"

namespace eval {
namespace {

constexpr double kErrorWidth_pt = 280.0, kShareWidth_pt = 150.0, kErrorHeight_pt = 150.0;
constexpr double kErrorBelow_pt = 34.0, kErrorEdge_pt = 10.0;
constexpr double kHeadroom = 1.05;

/// Times since the first pose, millimetres.
std::vector<PlotPoint> ErrorsOver(const PlottedRun& run) {
  return WithGaps(run, [&](const PoseError& pose) -> std::optional<PlotPoint> {
    if (!pose.position_m) return std::nullopt;
    const double start_s = run.evaluation.trajectory.errors.front().stamp_s;
    return PlotPoint{pose.stamp_s - start_s, 1e3 * *pose.position_m};
  });
}

/// The share of poses whose error is at most so large, as a staircase.
std::vector<PlotPoint> Distribution(const PlottedRun& run, double end_mm) {
  std::vector<double> errors_mm;
  for (const PoseError& pose : run.evaluation.trajectory.errors) {
    if (pose.position_m) errors_mm.push_back(1e3 * *pose.position_m);
  }
  std::sort(errors_mm.begin(), errors_mm.end());
  const double n = static_cast<double>(errors_mm.size());
  std::vector<PlotPoint> points;
  if (errors_mm.empty()) return points;
  points.push_back({0.0, 0.0});
  for (std::size_t i = 0; i < errors_mm.size(); ++i) {
    points.push_back({errors_mm[i], static_cast<double>(i) / n});
    points.push_back({errors_mm[i], static_cast<double>(i + 1) / n});
  }
  points.push_back({end_mm, 1.0});
  return points;
}

}  // namespace

std::vector<PlotFile> PlotErrors(const std::vector<PlottedRun>& runs) {
  double end_s = 0.0, end_mm = 0.0;
  std::vector<std::vector<PlotPoint>> errors;
  for (const PlottedRun& run : runs) {
    errors.push_back(ErrorsOver(run));
    for (const PlotPoint& point : errors.back()) {
      end_s = std::max(end_s, point.x);
      if (point.y > end_mm) end_mm = point.y;  // not a gap
    }
  }
  const bool any = std::any_of(errors.begin(), errors.end(),
                               [](const auto& points) { return !points.empty(); });
  if (!any) return {};
  end_mm = end_mm > 0.0 ? kHeadroom * end_mm : 1.0;
  const std::vector<LegendEntry> legend = LegendOf(runs);
  const double width =
      2.0 * kAxisLeft_pt + kErrorWidth_pt + kShareWidth_pt + 2.0 * kErrorEdge_pt;
  const double top = LegendHeight(width - kAxisLeft_pt, legend) + kErrorEdge_pt;
  const FigureSize size{width, top + kErrorHeight_pt + kErrorBelow_pt};
  return RenderFigure("position_error", size, [&](cairo_t* context) {
    DrawLegend(context, kAxisLeft_pt, 0.0, width - kAxisLeft_pt, legend);
    Axes over_time(context, {kAxisLeft_pt, top, kErrorWidth_pt, kErrorHeight_pt},
                   {"time (s)", 0.0, end_s}, {"position error (mm)", 0.0, end_mm});
    for (std::size_t i = 0; i < runs.size(); ++i) over_time.Line(errors[i], StyleOfSeries(i));
    const double left = 2.0 * kAxisLeft_pt + kErrorWidth_pt + kErrorEdge_pt;
    Axes shares(context, {left, top, kShareWidth_pt, kErrorHeight_pt},
                {"position error (mm)", 0.0, end_mm}, {"share of poses", 0.0, 1.0});
    for (std::size_t i = 0; i < runs.size(); ++i) {
      shares.Line(Distribution(runs[i], end_mm), StyleOfSeries(i));
    }
  });
}

}  // namespace eval
