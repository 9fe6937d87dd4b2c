#pragma once

#include "slam/segment/block_pixels.h"
#include "slam/segment/pixel_set.h"

namespace slam {

/// A plane near pixels of a block that others are near too.
struct BlockRival {
  ConstPixelSet near = nullptr;
  const float* bids = nullptr;  ///< BidForBlock
  PixelSet owned = nullptr;     ///< what it gets, and
  int pixels = 0;               ///< how many
};

/// Gives each pixel to the one with the least bid of those near it (the first of equal ones).
void ShareBlock(BlockRival* rivals, int rival_count, int size);

/// A label's pixels of a block.
struct BlockOwner {
  int label = 0;
  ConstPixelSet owned = nullptr;
};

/// Writes the labels of the pixels of a block, kNoLabel where nobody owns one.
/// @param labels  of its first pixel
void DrawOwners(const BlockPixels& block, const BlockOwner* owners, int owner_count,
                std::int16_t* labels);

/// Sets the marks of the pixels of a set to 0. @param marks  of the block's first pixel
void ClearMarks(const BlockPixels& block, ConstPixelSet set, std::uint8_t* marks);

}  // namespace slam
