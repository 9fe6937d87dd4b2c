#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/write/simulator.h"

namespace sim {

/// One picture of a frame: colour and measured depth above, plane ids and object ids below,
/// each as large as the frame. Depth goes from red (near) to blue (far) between its 1st and
/// 99th percentile, black where there is none; an id keeps its colour, 0 is black.
cv::Mat3b PreviewPicture(const SimulatedFrame& frame);

}  // namespace sim
