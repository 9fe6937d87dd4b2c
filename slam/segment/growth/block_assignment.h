#pragma once

#include <cstdint>

#include "slam/segment/pixels/block_pixels.h"

namespace slam {

/// A plane near pixels of a block that others are near too.
struct CompetingPlane {
  const float* costs = nullptr;  ///< FindCosts
  PixelSet owned = 0;            ///< set to the pixels that it gets
  int hypothesis = 0;            ///< its place in BlockHypotheses
};

/// Gives each pixel to the plane of least cost of those near it, to the first of equal ones.
void AssignPixels(CompetingPlane* planes, int plane_count);

/// A label's pixels of a block.
struct BlockOwner {
  int label = 0;
  PixelSet owned = 0;
};

/// Writes the labels of the pixels of a block, kNoLabel where nobody owns one.
/// @param labels  where the first pixel's is
/// @param stride  from row to row of them
void DrawOwners(const BlockPixels& block, const BlockOwner* owners, int owner_count,
                std::int16_t* labels, int stride);

}  // namespace slam
