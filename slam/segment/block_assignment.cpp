#include "slam/segment/block_assignment.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "slam/base/lane_math.h"
#include "slam/segment/label_runs.h"
#include "slam/segment/pixel_set_lanes.h"

namespace slam {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

using EightMarks = std::uint8_t __attribute__((vector_size(8), aligned(1), may_alias));
using EightShorts = std::int16_t __attribute__((vector_size(16), aligned(2), may_alias));

SLAM_INLINE void AssignPixels8(const CompetingPlane* planes, int plane_count) {
  FloatLanes lowest[kLanes];
#pragma GCC unroll 8
  for (FloatLanes& row : lowest) row = AllLanes(kNone);
  for (int r = 0; r < plane_count; ++r) {
    RowsOfSet better;
#pragma GCC unroll 8
    for (int v = kLanes - 1; v >= 0; --v) {
      const FloatLanes cost = Lanes(planes[r].costs + kLanes * v);
      const IntLanes is_better = cost < lowest[v];
      lowest[v] = is_better ? cost : lowest[v];
      better.Add(is_better);
    }
    *planes[r].owned = better.Set();
  }
  std::uint64_t taken = 0;  // the last one that was better has it
  for (int r = plane_count - 1; r >= 0; --r) {
    *planes[r].owned &= ~taken;
    taken |= *planes[r].owned;
  }
}

void AssignPixelsAny(const CompetingPlane* planes, int plane_count, int size) {
  for (int r = 0; r < plane_count; ++r)
    std::fill_n(planes[r].owned, WordsOfSet(size), std::uint64_t{0});
  for (int v = 0; v < size; ++v) {
    for (int u = 0; u < size; ++u) {
      const CompetingPlane* owner = nullptr;
      float lowest = kNone;
      for (const CompetingPlane* p = planes; p < planes + plane_count; ++p) {
        if (!IsInSet(p->near, size, u, v)) continue;
        const float cost = p->costs[v * size + u];
        if (cost < lowest) lowest = cost, owner = p;
      }
      if (owner != nullptr) PutInSet(owner->owned, size, u, v);
    }
  }
}

}  // namespace

SLAM_LANES void AssignPixels(CompetingPlane* planes, int plane_count, int size) {
  if (size == kLanes) {
    AssignPixels8(planes, plane_count);
  } else {
    AssignPixelsAny(planes, plane_count, size);
  }
  for (int r = 0; r < plane_count; ++r)
    planes[r].pixels = CountOf(planes[r].owned, WordsOfSet(size));
}

SLAM_LANES void DrawOwners(const BlockPixels& block, const BlockOwner* owners, int owner_count,
                           std::int16_t* labels) {
  if (block.size == kLanes && block.width == kLanes) {
    EightShorts rows[kLanes];
#pragma GCC unroll 8
    for (EightShorts& row : rows) row = EightShorts{} + kNoLabel;
    for (int r = 0; r < owner_count; ++r) {
      const EightShorts label = EightShorts{} + static_cast<std::int16_t>(owners[r].label);
      if (*owners[r].owned == ~std::uint64_t{0}) {
#pragma GCC unroll 8
        for (EightShorts& row : rows) row = label;
        break;
      }
      const EightShorts columns =
          __builtin_convertvector(ColumnsOf(*owners[r].owned), EightShorts);
#pragma GCC unroll 8
      for (int v = 0; v < kLanes; ++v)
        rows[v] = (EightShorts)(columns << (15 - v) < 0) ? label : rows[v];
    }
#pragma GCC unroll 8
    for (int v = 0; v < kLanes; ++v) {
      if (v == block.height) break;
      *reinterpret_cast<EightShorts*>(labels + static_cast<std::ptrdiff_t>(v) * block.stride) =
          rows[v];
    }
    return;
  }
  for (int v = 0; v < block.height; ++v) {
    std::int16_t* row = labels + static_cast<std::ptrdiff_t>(v) * block.stride;
    std::fill_n(row, block.width, kNoLabel);
    for (const BlockOwner* r = owners; r < owners + owner_count; ++r) {
      for (int u = 0; u < block.width; ++u)
        if (IsInSet(r->owned, block.size, u, v)) row[u] = static_cast<std::int16_t>(r->label);
    }
  }
}

SLAM_LANES void ClearMarks(const BlockPixels& block, ConstPixelSet set, std::uint8_t* marks) {
  if (block.size == kLanes && block.width == kLanes) {
    const EightShorts columns = __builtin_convertvector(ColumnsOf(*set), EightShorts);
    for (int v = 0; v < block.height; ++v) {
      const EightShorts stays = ((columns >> v) & 1) - 1;
      *reinterpret_cast<EightMarks*>(marks + static_cast<std::ptrdiff_t>(v) * block.stride) &=
          __builtin_convertvector(stays, EightMarks);
    }
    return;
  }
  for (int v = 0; v < block.height; ++v) {
    std::uint8_t* row = marks + static_cast<std::ptrdiff_t>(v) * block.stride;
    for (int u = 0; u < block.width; ++u)
      if (IsInSet(set, block.size, u, v)) row[u] = 0;
  }
}

}  // namespace slam
