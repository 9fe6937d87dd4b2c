#pragma once

#include <opencv2/core.hpp>

#include "eval/draw/map_drawing.h"

namespace eval {

/// Draws the level planes from the side into `panel`: a bar for each over its x extent, at its
/// height above the base plane in mm (BasePlane), with the true planes dashed. Labels with the
/// steps stand to the right of the panel. Planes more than 0.4 m from the base are
/// named below the panel.
void PutElevation(cv::Mat& page, const MapScene& scene, const MapScale& scale,
                  cv::Rect2d panel);

}  // namespace eval
