#include <algorithm>
#include <cmath>

#include "eval/plot/axes.h"
#include "eval/plot/plotted_run.h"

namespace eval {
namespace {

constexpr double kStepWidth_pt = 200.0, kStepHeight_pt = 150.0;
constexpr double kStepBelow_pt = 34.0, kStepEdge_pt = 10.0;

std::vector<StepScore> StepsOf(const PlottedRun& run) {
  const auto& planes = run.evaluation.planes;
  return planes && planes->from_frame_planes ? planes->steps : std::vector<StepScore>();
}

/// In the middle of its class, on the logarithmic axis.
double HeightOf(const StepScore& step) { return std::sqrt(step.min_mm * step.max_mm); }

void DrawShares(Axes& axes, const std::vector<StepScore>& steps, const SeriesStyle& style,
                bool precision) {
  std::vector<PlotPoint> points;
  for (const StepScore& step : steps) {
    const int right = precision ? step.right_planes : step.right;
    const int whole = precision ? step.right_planes + step.wrong_planes : step.seen;
    if (whole > 0) points.push_back({HeightOf(step), double(right) / whole});
  }
  axes.Line(points, style);
  axes.Markers(points, style);
}

}  // namespace

std::vector<PlotFile> PlotSteps(const std::vector<PlottedRun>& runs) {
  double min_mm = 1e9, max_mm = 0.0;
  for (const PlottedRun& run : runs) {
    for (const StepScore& step : StepsOf(run)) {
      min_mm = std::min(min_mm, step.min_mm);
      max_mm = std::max(max_mm, step.max_mm);
    }
  }
  if (!(max_mm > min_mm)) return {};
  const std::vector<LegendEntry> legend = LegendOf(runs);
  const double width = 2.0 * (kAxisLeft_pt + kStepWidth_pt + kStepEdge_pt);
  const double top = LegendHeight(width - kAxisLeft_pt, legend) + kStepEdge_pt;
  const FigureSize size{width, top + kStepHeight_pt + kStepBelow_pt};
  return RenderFigure("step_height", size, [&](cairo_t* context) {
    DrawLegend(context, kAxisLeft_pt, 0.0, width - kAxisLeft_pt, legend);
    for (const bool precision : {true, false}) {
      const double left = precision ? kAxisLeft_pt : 0.5 * width + kAxisLeft_pt;
      PlotAxis height{"step height (mm)", min_mm, max_mm};
      height.logarithmic = true;
      Axes axes(context, {left, top, kStepWidth_pt, kStepHeight_pt}, height,
                {precision ? "precision" : "recall", 0.0, 1.0});
      for (std::size_t i = 0; i < runs.size(); ++i) {
        DrawShares(axes, StepsOf(runs[i]), StyleOfSeries(i), precision);
      }
    }
  });
}

}  // namespace eval
