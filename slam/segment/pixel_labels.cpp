#include "slam/segment/pixel_labels.h"

#include "slam/segment/block_sums.h"

namespace slam {
namespace {

constexpr int kSumTile_px = 8;

}  // namespace

std::vector<PlaneSums> SumLabels(const DepthGrid& grid, const LabelImage& labels, int count) {
  std::vector<PlaneSums> sums(static_cast<std::size_t>(count));
  for (int v = 0; v < grid.height; v += kSumTile_px) {
    for (int u = 0; u < grid.width; u += kSumTile_px) {
      SumTile(BlockAt(grid, u, v, kSumTile_px),
              labels.data() + static_cast<std::size_t>(grid.Index(u, v)), sums);
    }
  }
  return sums;
}

}  // namespace slam
