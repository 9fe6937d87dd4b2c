#pragma once

#include "slam/segment/block_pixels.h"
#include "slam/segment/pixel_set.h"

namespace slam {

/// A plane near pixels of a block that others are near too.
struct CompetingPlane {
  ConstPixelSet near = nullptr;
  const float* costs = nullptr;  ///< FindCosts
  PixelSet owned = nullptr;      ///< set to the pixels that it gets, and
  int pixels = 0;                ///< to their number
};

/// Gives each pixel to the plane of least cost of those near it, to the first of equal ones.
void AssignPixels(CompetingPlane* planes, int plane_count, int size);

/// A label's pixels of a block.
struct BlockOwner {
  int label = 0;
  ConstPixelSet owned = nullptr;
};

/// Writes the labels of the pixels of a block, kNoLabel where nobody owns one.
/// @param labels  where the first pixel's is
void DrawOwners(const BlockPixels& block, const BlockOwner* owners, int owner_count,
                std::int16_t* labels);

/// Sets the marks of the pixels of a set to 0. @param marks  where the block's first pixel's is
void ClearMarks(const BlockPixels& block, ConstPixelSet set, std::uint8_t* marks);

}  // namespace slam
