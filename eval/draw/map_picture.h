#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "eval/draw/map_drawing.h"
#include "eval/draw/run_title.h"

namespace eval {

/// The map seen from above (estimated planes in their colours over the outlines of the true
/// ones, both paths, scale bar, legend), and below it, on the same x axis, the heights of the
/// level planes in mm.
cv::Mat DrawMap(const MapScene& scene, const RunTitle& title);

/// The label of a plane in the view from above.
struct MapLabel {
  int id = 0;
  std::string text;
  cv::Rect2d place;  ///< pixels of the view
  double height_px = 0;
  bool bold = false;
};
/// The labels that find room, none over another: level planes before others, large ones before
/// small ones. `scale.page` begins at (0, 0).
std::vector<MapLabel> LabelsOfMap(const MapScene& scene, const MapScale& scale);

/// The fill of a level plane: pale and nearly opaque, so that what lies under it is still seen,
/// and the colours of a stack do not run into one.
inline constexpr double kLevelOpacity = 0.85;
cv::Scalar LevelFill(int id);

/// Colours that both views share.
inline const cv::Scalar kInkColour{60, 55, 50}, kTruthColour{35, 30, 28};

}  // namespace eval
