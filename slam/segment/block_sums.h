#pragma once

#include <cstdint>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/block_pixels.h"

namespace slam {

/// Sums of the measured pixels of a block.
PlaneSums SumBlock(const BlockPixels& block, ConstPixelSet measured);

/// Sums of its pixels in a set, all of them measured.
PlaneSums SumOfSet(const BlockPixels& block, ConstPixelSet set);

/// Sums of its measured pixels whose entry is 0.
/// @param taken  where its first pixel's entry is
PlaneSums SumFree(const BlockPixels& block, const std::uint8_t* taken);

/// How many measured pixels with an entry of 0 each column of some rows has; 255 rows at most.
/// @param g, taken  where the first pixel's are; rows begin `stride` apart
void CountFree(const float* g, const std::uint8_t* taken, int stride, int width, int height,
               std::uint8_t* counts);

/// Whether two neighbouring measured pixels differ by more than `max_sigmas`.
bool HasJump(const BlockPixels& block, float max_sigmas);

}  // namespace slam
