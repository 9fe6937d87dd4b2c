#include "slam/segment/pixels/image_blocks.h"

#include <algorithm>

namespace slam {
namespace {

constexpr int kCopySide_px = kBlock_px + 2 * kVoteReach_px;
constexpr std::size_t kCopyPixels = kCopySide_px * kCopySide_px;
constexpr std::size_t kCopyNumbers = 4;  // x, y, q and g

/// Whether a block and what it looks at lie in the image.
bool IsInside(const DepthGrid& grid, int u, int v) {
  return u >= kVoteReach_px && v >= kVoteReach_px &&
         u + kBlock_px + kVoteReach_px <= grid.width &&
         v + kBlock_px + kVoteReach_px <= grid.height;
}

/// The block at (u, v) where it lies in the grid.
BlockPixels BlockInGrid(const DepthGrid& grid, int u, int v) {
  const auto i = static_cast<std::ptrdiff_t>(v) * grid.width + u;
  const bool one_x = !grid.column_x.empty();
  return {one_x ? grid.column_x.data() + u : grid.x.data() + i,
          grid.y.data() + i,
          grid.q.data() + i,
          grid.g.data() + i,
          grid.width,
          one_x ? 0 : grid.width,
          std::min(kBlock_px, grid.width - u),
          std::min(kBlock_px, grid.height - v)};
}

/// The same in a copy. @param copy  room for kCopyNumbers * kCopyPixels zeros
BlockPixels CopyOfBlock(const DepthGrid& grid, int u, int v, float* copy) {
  const int u0 = u - kVoteReach_px, v0 = v - kVoteReach_px;
  const int left = std::max(u0, 0), right = std::min(u0 + kCopySide_px, grid.width);
  const int bottom = std::min(v0 + kCopySide_px, grid.height);
  BlockPixels block = BlockInGrid(grid, u, v);
  const auto copy_of = [&](const std::vector<float>& from) {
    for (int row = std::max(v0, 0); row < bottom; ++row)
      std::copy_n(from.data() + grid.Index(left, row), right - left,
                  copy + ((row - v0) * kCopySide_px + left - u0));
    const float* first = copy + (kVoteReach_px * kCopySide_px + kVoteReach_px);
    copy += kCopyPixels;
    return first;
  };
  block.x = copy_of(grid.x), block.y = copy_of(grid.y);
  block.q = copy_of(grid.q), block.g = copy_of(grid.g);
  block.stride = block.x_stride = kCopySide_px;
  return block;
}

}  // namespace

void SetBlocks(const DepthGrid& grid, ImageBlocks& blocks) {
  blocks.cols = (grid.width + kBlock_px - 1) / kBlock_px;
  blocks.rows = (grid.height + kBlock_px - 1) / kBlock_px;
  std::size_t copied = 0;
  for (int v = 0; v < grid.height; v += kBlock_px)
    for (int u = 0; u < grid.width; u += kBlock_px) copied += IsInside(grid, u, v) ? 0 : 1;
  blocks.copies.assign(copied * kCopyNumbers * kCopyPixels, 0.0f);

  blocks.pixels.clear(), blocks.measured.clear();
  float* copy = blocks.copies.data();
  for (int v = 0; v < grid.height; v += kBlock_px) {
    for (int u = 0; u < grid.width; u += kBlock_px) {
      const bool inside = IsInside(grid, u, v);
      blocks.pixels.push_back(inside ? BlockInGrid(grid, u, v) : CopyOfBlock(grid, u, v, copy));
      copy += inside ? 0 : kCopyNumbers * kCopyPixels;
      blocks.measured.push_back(FindMeasured(blocks.pixels.back()));
    }
  }
}

}  // namespace slam
