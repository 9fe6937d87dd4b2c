#pragma once

#include <cstdint>
#include <vector>

#include "slam/extract/depth_grid.h"
#include "slam/extract/plane_sums.h"

namespace slam {

/// The image cut into square blocks, row by row; the last row and column may be cut.
struct BlockLayout {
  int block_px = 8, cols = 0, rows = 0, width = 0, height = 0;

  BlockLayout() = default;
  BlockLayout(const DepthGrid& grid, int size)
      : block_px(size),
        cols((grid.width + size - 1) / size),
        rows((grid.height + size - 1) / size),
        width(grid.width),
        height(grid.height) {}
  int Count() const { return cols * rows; }
  int Left(int block) const { return block % cols * block_px; }
  int Top(int block) const { return block / cols * block_px; }
  int Right(int block) const { return std::min(Left(block) + block_px, width); }
  int Bottom(int block) const { return std::min(Top(block) + block_px, height); }
};

/// Sums of the measured pixels of a block that are not taken.
///
/// Pixels are added in single precision about the block's middle, in columns, and moved to the
/// origin in double: what is lost is below the rounding of the pixels themselves.
/// @param taken  one entry a pixel, non-zero = left out; null: none is
PlaneSums SumBlock(const DepthGrid& grid, const BlockLayout& layout, int block,
                   const std::uint8_t* taken);

/// Sums of the measured pixels of a block that carry a label.
PlaneSums SumLabel(const DepthGrid& grid, const BlockLayout& layout, int block,
                   const std::vector<std::int32_t>& labels, std::int32_t label);

/// Largest |difference| of neighbouring pixels of a block, in sigmas.
float LargestJump(const DepthGrid& grid, const BlockLayout& layout, int block);

}  // namespace slam
