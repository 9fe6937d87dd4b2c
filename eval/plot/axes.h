#pragma once

#include <cairo.h>

#include <optional>
#include <string>
#include <vector>

namespace eval {

/// Room at the left of a panel: the names of ticks of seven characters, and the label of the axis.
inline constexpr double kAxisLeft_pt = 56.0;

/// A point of a plot, in the units of its axes.
struct PlotPoint {
  double x = 0.0, y = 0.0;
};

/// Where a panel lies in a figure, points, y down.
struct PanelBox {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

/// One axis: its label with the unit, and what it shows.
struct PlotAxis {
  std::string label;
  double min = 0.0, max = 1.0;
  bool logarithmic = false;
  std::vector<std::string> categories = {};  ///< names at 0, 1, ...; instead of numbers
};

/// How a series looks. Colours are those of Okabe and Ito, which people with any colour vision can
/// tell apart; beyond seven series dashes tell them apart too.
struct SeriesStyle {
  double red = 0.0, green = 0.0, blue = 0.0;
  double dash_pt = 0.0;  ///< 0 = solid
  double width_pt = 1.2;
};
SeriesStyle StyleOfSeries(std::size_t number);
SeriesStyle StyleOfTruth();

/// One panel of a figure: a frame with ticks, into which series are drawn.
class Axes {
 public:
  /// Draws frame, ticks, grid and labels. An axis without extent is widened.
  Axes(cairo_t* context, const PanelBox& box, PlotAxis x, PlotAxis y);

  /// Neighbours are joined; one that is not finite leaves a gap.
  void Line(const std::vector<PlotPoint>& points, const SeriesStyle& style);
  void Markers(const std::vector<PlotPoint>& points, const SeriesStyle& style);
  void Bar(double x_min, double x_max, double y, const SeriesStyle& style);
  /// A vertical line with a short bar at its end.
  void Whisker(double x, double y_min, double y_max, const SeriesStyle& style);

 private:
  double AtX(double x) const;
  double AtY(double y) const;
  void DrawFrame();
  void DrawTicksX();
  void DrawTicksY();
  void Select(const SeriesStyle& style);

  cairo_t* context_;
  PanelBox box_;
  PlotAxis x_, y_;
};

/// A line of names with their styles, left to right; wraps at `width`.
struct LegendEntry {
  std::string name;
  SeriesStyle style;
};
/// @returns the height that it takes
double DrawLegend(cairo_t* context, double x, double y, double width,
                  const std::vector<LegendEntry>& entries);
/// The height without drawing.
double LegendHeight(double width, const std::vector<LegendEntry>& entries);

/// Round numbers from min to max, some five of them: multiples of 1, 2 or 5 times a power of ten.
std::vector<double> RoundTicks(double min, double max);

}  // namespace eval
