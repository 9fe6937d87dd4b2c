#include "slam/extract/pixel_labels.h"

#include "slam/extract/block_sums.h"

namespace slam {
namespace {

constexpr int kTile_px = 8;

}  // namespace

std::vector<PlaneSums> SumLabels(const DepthGrid& grid, const LabelImage& labels, int count) {
  std::vector<PlaneSums> sums(static_cast<std::size_t>(count));
  for (int v = 0; v < grid.height; v += kTile_px) {
    for (int u = 0; u < grid.width; u += kTile_px) {
      SumTile(BlockAt(grid, u, v, kTile_px),
              labels.data() + static_cast<std::size_t>(grid.Index(u, v)), sums);
    }
  }
  return sums;
}

}  // namespace slam
