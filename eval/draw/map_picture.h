#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "eval/draw/map_drawing.h"

namespace eval {

/// The map seen from above (estimated planes in their colours over the outlines of the true
/// ones, both paths, scale bar, legend), and below it, on the same x axis, the heights of the
/// level planes in mm.
cv::Mat DrawMap(const MapScene& scene, const std::string& title);

/// Colours that both views share.
inline const cv::Scalar kInkColour{60, 55, 50}, kTruthColour{35, 30, 28};

}  // namespace eval
