#pragma once

#include <opencv2/core.hpp>

#include "eval/surfaces/depth_views.h"
#include "eval/surfaces/surface.h"

namespace eval {

/// The outlines of all surfaces from above and the way of the camera. Up is the direction that
/// the cameras hold up in the mean, or the normal of a large surface that is near to it.
cv::Mat DrawPlan(const SurfaceFile& file, const DepthViews& views, cv::Size size);

}  // namespace eval
