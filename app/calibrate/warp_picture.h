#pragma once

#include <opencv2/core/mat.hpp>

#include "slam/calibrate/depth_warp.h"

namespace app {

/// A page with the pattern and its standard deviation, each with a scale in mm/m.
cv::Mat3b DrawWarp(const slam::DepthWarp& warp);

}  // namespace app
