#include <algorithm>

#include "eval/plot/axes.h"
#include "eval/plot/plotted_run.h"

namespace eval {
namespace {

constexpr double kModule_pt = 44.0, kTimeHeight_pt = 150.0;  // of one module, of the panel
constexpr double kTimeBelow_pt = 34.0, kTimeEdge_pt = 10.0;
constexpr double kGroupShare = 0.8;  // of a module's place, for the bars of all runs
constexpr double kTimeHeadroom = 1.05;

/// Modules of all runs, in the order of the first run that has them.
std::vector<std::string> ModulesOf(const std::vector<PlottedRun>& runs) {
  std::vector<std::string> modules;
  for (const PlottedRun& run : runs) {
    if (!run.evaluation.timing) continue;
    for (const ModuleTime& time : run.evaluation.timing->modules) {
      if (std::find(modules.begin(), modules.end(), time.module) == modules.end()) {
        modules.push_back(time.module);
      }
    }
  }
  return modules;
}

void DrawBars(Axes& axes, const PlottedRun& run, const std::vector<std::string>& modules,
              std::size_t number, std::size_t count) {
  if (!run.evaluation.timing) return;
  const double width = kGroupShare / static_cast<double>(count);
  for (const ModuleTime& time : run.evaluation.timing->modules) {
    const auto at = std::find(modules.begin(), modules.end(), time.module) - modules.begin();
    const double left =
        static_cast<double>(at) - 0.5 * kGroupShare + width * static_cast<double>(number);
    axes.Bar(left, left + width, time.mean, StyleOfSeries(number));
    axes.Whisker(left + 0.5 * width, time.mean, std::max(time.mean, time.p95), StyleOfTruth());
  }
}

}  // namespace

std::vector<PlotFile> PlotTimes(const std::vector<PlottedRun>& runs) {
  const std::vector<std::string> modules = ModulesOf(runs);
  if (modules.empty()) return {};
  double end_ms = 0.0;
  for (const PlottedRun& run : runs) {
    if (!run.evaluation.timing) continue;
    for (const ModuleTime& time : run.evaluation.timing->modules) {
      end_ms = std::max({end_ms, time.mean, time.p95});
    }
  }
  const std::vector<LegendEntry> legend = LegendOf(runs);
  const double panel = kModule_pt * static_cast<double>(modules.size());
  const double width = kAxisLeft_pt + panel + kTimeEdge_pt;
  const double top = LegendHeight(width - kAxisLeft_pt, legend) + kTimeEdge_pt;
  const FigureSize size{width, top + kTimeHeight_pt + kTimeBelow_pt};
  return RenderFigure("module_times", size, [&](cairo_t* context) {
    DrawLegend(context, kAxisLeft_pt, 0.0, width - kAxisLeft_pt, legend);
    PlotAxis places{"module", -0.5, static_cast<double>(modules.size()) - 0.5, false, modules};
    Axes axes(context, {kAxisLeft_pt, top, panel, kTimeHeight_pt}, places,
              {"time a frame (ms)", 0.0, kTimeHeadroom * end_ms});
    for (std::size_t i = 0; i < runs.size(); ++i) {
      DrawBars(axes, runs[i], modules, i, runs.size());
    }
  });
}

}  // namespace eval
