#include "slam/segment/growth/block_assignment.h"

#include <cstddef>
#include <limits>

#include "slam/base/lane_math.h"
#include "slam/segment/pixels/label_runs.h"
#include "slam/segment/pixels/pixel_set_lanes.h"

namespace slam {
namespace {

using EightShorts = std::int16_t __attribute__((vector_size(16)));

}  // namespace

SLAM_LANES void AssignPixels(CompetingPlane* planes, int plane_count) {
  FloatLanes lowest[kLanes];
#pragma GCC unroll 8
  for (FloatLanes& row : lowest) row = AllLanes(std::numeric_limits<float>::infinity());
  for (int r = 0; r < plane_count; ++r) {
    RowsOfSet better;
#pragma GCC unroll 8
    for (int v = kLanes - 1; v >= 0; --v) {
      const FloatLanes cost = Lanes(planes[r].costs + kLanes * v);
      const IntLanes is_better = cost < lowest[v];
      lowest[v] = is_better ? cost : lowest[v];
      better.Add(is_better);
    }
    planes[r].owned = better.Set();
  }
  PixelSet taken = 0;  // the last one that was better has it
  for (int r = plane_count - 1; r >= 0; --r) {
    planes[r].owned &= ~taken;
    taken |= planes[r].owned;
  }
}

SLAM_LANES void DrawOwners(const BlockPixels& block, const BlockOwner* owners, int owner_count,
                           std::int16_t* labels, int stride) {
  EightShorts rows[kLanes];
#pragma GCC unroll 8
  for (EightShorts& row : rows) row = EightShorts{} + kNoLabel;
  for (int r = 0; r < owner_count; ++r) {
    const EightShorts label = EightShorts{} + static_cast<std::int16_t>(owners[r].label);
    if (owners[r].owned == ~PixelSet{0}) {
#pragma GCC unroll 8
      for (EightShorts& row : rows) row = label;
      break;
    }
    const EightShorts columns =
        __builtin_convertvector(ColumnsOf(owners[r].owned), EightShorts);
#pragma GCC unroll 8
    for (int v = 0; v < kLanes; ++v)
      rows[v] = (EightShorts)(columns << (15 - v) < 0) ? label : rows[v];
  }
#pragma GCC unroll 8
  for (int v = 0; v < kLanes; ++v) {
    if (v == block.height) break;
    std::int16_t* row = labels + static_cast<std::ptrdiff_t>(v) * stride;
    if (block.width == kLanes) {
      Store(rows[v], row);
    } else {
      for (int u = 0; u < block.width; ++u) row[u] = rows[v][u];
    }
  }
}

}  // namespace slam
