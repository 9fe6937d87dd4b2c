#pragma once

#include <cairo.h>

#include <functional>
#include <string>
#include <vector>

namespace eval {

/// A plot as it is written: the same drawing three times.
struct PlotFile {
  std::string name;  ///< "error_over_time.svg"
  std::string bytes;
};

/// Size of a plot, points (1/72 inch).
struct FigureSize {
  double width_pt = 0.0, height_pt = 0.0;
};

/// Draws a figure as NAME.svg, NAME.pdf and NAME.png (white ground). The same drawing gives the same
/// bytes: no file holds a date.
/// @throws std::runtime_error when Cairo fails
std::vector<PlotFile> RenderFigure(const std::string& name, const FigureSize& size,
                                   const std::function<void(cairo_t*)>& draw);

}  // namespace eval
