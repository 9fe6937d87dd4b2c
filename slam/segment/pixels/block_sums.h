#pragma once

#include "slam/geometry/plane_sums.h"
#include "slam/segment/pixels/block_pixels.h"

namespace slam {

/// Sums of the pixels of a set, all of them measured and in the window.
PlaneSums SumOfSet(const BlockPixels& block, PixelSet set, const BlockWindow& window = {});

/// Whether two neighbouring measured pixels of the window differ by more than `max_sigmas`.
bool HasJump(const BlockPixels& block, float max_sigmas, const BlockWindow& window = {});

}  // namespace slam
