#pragma once

#include <cstddef>
#include <vector>

#include "slam/base/index.h"
#include "slam/segment/pixels/block_pixels.h"

namespace slam {

/// A depth image in blocks of 8 x 8 pixels. Those that end beyond the image, or look beyond it,
/// are copies that go on with pixels that are not measured, so that all blocks are alike.
struct ImageBlocks {
  int cols = 0, rows = 0;
  std::vector<BlockPixels> pixels;  ///< row by row
  std::vector<PixelSet> measured;   ///< the same
  std::vector<float> copies;

  int count() const { return cols * rows; }
  const BlockPixels& PixelsOf(int block) const { return pixels[Index(block)]; }
  PixelSet MeasuredOf(int block) const { return measured[Index(block)]; }
};

/// @param blocks  what is in it is forgotten; reads from the grid as long as it is used
void SetBlocks(const DepthGrid& grid, ImageBlocks& blocks);

}  // namespace slam
