#include "slam/segment/block_rivals.h"

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

SLAM_INLINE void ShareBlock8(const BlockRival* rivals, int rival_count) {
  FloatLanes least[kLanes];
#pragma GCC unroll 8
  for (FloatLanes& row : least) row = AllLanes(kNone);
  for (int r = 0; r < rival_count; ++r) {
    RowsOfSet better;
#pragma GCC unroll 8
    for (int v = kLanes - 1; v >= 0; --v) {
      const FloatLanes bid = Lanes(rivals[r].bids + kLanes * v);
      const IntLanes is_better = bid < least[v];
      least[v] = is_better ? bid : least[v];
      better.Add(is_better);
    }
    *rivals[r].owned = better.Set();
  }
  std::uint64_t taken = 0;  // the last one that was better has it
  for (int r = rival_count - 1; r >= 0; --r) {
    *rivals[r].owned &= ~taken;
    taken |= *rivals[r].owned;
  }
}

void ShareBlockAny(const BlockRival* rivals, int rival_count, int size) {
  for (int r = 0; r < rival_count; ++r)
    std::fill_n(rivals[r].owned, WordsOfSet(size), std::uint64_t{0});
  for (int v = 0; v < size; ++v) {
    for (int u = 0; u < size; ++u) {
      const BlockRival* owner = nullptr;
      float least = kNone;
      for (const BlockRival* r = rivals; r < rivals + rival_count; ++r) {
        if (!IsInSet(r->near, size, u, v)) continue;
        const float bid = r->bids[v * size + u];
        if (bid < least) least = bid, owner = r;
      }
      if (owner != nullptr) PutInSet(owner->owned, size, u, v);
    }
  }
}

}  // namespace

SLAM_LANES void ShareBlock(BlockRival* rivals, int rival_count, int size) {
  if (size == kLanes) {
    ShareBlock8(rivals, rival_count);
  } else {
    ShareBlockAny(rivals, rival_count, size);
  }
  for (int r = 0; r < rival_count; ++r)
    rivals[r].pixels = CountOf(rivals[r].owned, WordsOfSet(size));
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
