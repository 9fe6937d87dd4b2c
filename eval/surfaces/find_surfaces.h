#pragma once

#include <functional>

#include "eval/surfaces/depth_views.h"
#include "eval/surfaces/surface.h"

namespace eval {

/// What is told while the views are read, in two passes: which one, and done of total.
using TellProgress = std::function<void(const char* pass, int done, int total)>;

/// The noise of one pixel's inverse depth, 1/m, as the recording shows it on smooth places.
double MeasureNoise(const DepthViews& views);

/// The large flat surfaces of a recording, found in its depth with its own camera truth:
/// smooth points of all views are laid together and averaged in cells, planes are grown through
/// the cells and joined where they are one, every pixel is then given to the plane that it lies
/// on, and the maps of heights over the planes are cut where they step. Largest first, ids from
/// 1. The same input gives the same bytes.
/// @param min_area_m2  of a surface; smaller ones are left out
SurfaceFile FindSurfaces(const DepthViews& views, double min_area_m2,
                         const TellProgress& tell = {});

}  // namespace eval
