#include <algorithm>
#include <limits>

#include "eval/plot/axes.h"
#include "eval/plot/plotted_run.h"

namespace eval {
namespace {

constexpr double kPanel_pt = 230.0;      // longer side of the panel
constexpr double kMinPanelShare = 0.35;  // of the shorter side, for paths that are nearly lines
constexpr double kPathMargin = 0.05;     // share of the path's extent around it
constexpr double kBelow_pt = 34.0, kEdge_pt = 10.0;

struct Extent {
  double min_x = std::numeric_limits<double>::infinity(), max_x = -min_x;
  double min_y = min_x, max_y = -min_x;

  void Add(const Eigen::Vector3d& p) {
    min_x = std::min(min_x, p.x()), max_x = std::max(max_x, p.x());
    min_y = std::min(min_y, p.y()), max_y = std::max(max_y, p.y());
  }
};

/// One scale on both axes: the extent is widened to the shape of the panel.
struct Panel {
  double width_pt = 0.0, height_pt = 0.0;
  Extent extent;
};

Panel PanelOf(Extent e) {
  double width = (e.max_x - e.min_x) * (1.0 + 2.0 * kPathMargin);
  double height = (e.max_y - e.min_y) * (1.0 + 2.0 * kPathMargin);
  const double side = std::max({width, height, std::numeric_limits<double>::min()});
  width = std::max(width, kMinPanelShare * side);
  height = std::max(height, kMinPanelShare * side);
  const double middle_x = 0.5 * (e.min_x + e.max_x), middle_y = 0.5 * (e.min_y + e.max_y);
  Extent shown;
  shown.min_x = middle_x - 0.5 * width, shown.max_x = middle_x + 0.5 * width;
  shown.min_y = middle_y - 0.5 * height, shown.max_y = middle_y + 0.5 * height;
  return {kPanel_pt * width / side, kPanel_pt * height / side, shown};
}

std::vector<PlotPoint> TruePath(const PlottedRun& run) {
  std::vector<PlotPoint> path;
  for (const Eigen::Vector3d& position_g : run.evaluation.trajectory.true_positions_g) {
    path.push_back({position_g.x(), position_g.y()});
  }
  return path;
}

std::vector<PlotPoint> EstimatedPath(const PlottedRun& run) {
  return WithGaps(run, [](const PoseError& pose) -> std::optional<PlotPoint> {
    if (!pose.position_g) return std::nullopt;
    return PlotPoint{pose.position_g->x(), pose.position_g->y()};
  });
}

}  // namespace

std::vector<PlotFile> PlotTrajectories(const std::vector<PlottedRun>& runs) {
  Extent extent;
  for (const PlottedRun& run : runs) {
    if (run.evaluation.trajectory.errors.empty()) continue;
    for (const Eigen::Vector3d& x_g : run.evaluation.trajectory.true_positions_g)
      extent.Add(x_g);
    for (const PoseError& pose : run.evaluation.trajectory.errors) {
      if (pose.position_g) extent.Add(*pose.position_g);
    }
  }
  if (!(extent.max_x >= extent.min_x)) return {};
  const Panel panel = PanelOf(extent);
  std::vector<LegendEntry> legend = LegendOf(runs);
  legend.insert(legend.begin(), {"truth", StyleOfTruth()});
  const double width = kAxisLeft_pt + panel.width_pt + kEdge_pt;
  const double legend_height = LegendHeight(width - 2.0 * kEdge_pt, legend);
  const FigureSize size{width, legend_height + panel.height_pt + kBelow_pt + kEdge_pt};
  return RenderFigure("trajectories", size, [&](cairo_t* context) {
    DrawLegend(context, kEdge_pt, 0.0, width - 2.0 * kEdge_pt, legend);
    const Extent& shown = panel.extent;
    Axes axes(context,
              {kAxisLeft_pt, legend_height + kEdge_pt, panel.width_pt, panel.height_pt},
              {"x (m)", shown.min_x, shown.max_x}, {"y (m)", shown.min_y, shown.max_y});
    for (const PlottedRun& run : runs) axes.Line(TruePath(run), StyleOfTruth());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      axes.Line(EstimatedPath(runs[i]), StyleOfSeries(i));
    }
  });
}

}  // namespace eval
