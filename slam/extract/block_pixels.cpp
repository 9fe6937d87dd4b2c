#include "slam/extract/block_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "slam/base/lane_math.h"

namespace slam {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr int kReach8 = 2;                    // of the usual bid
constexpr int kSide8 = kLanes + 2 * kReach8;  // what it looks at

using EightLabels = std::int16_t __attribute__((vector_size(16), aligned(2), may_alias));
SLAM_INLINE EightLabels Labels8(const std::int16_t* p) {
  return *reinterpret_cast<const EightLabels*>(p);
}

/// Residuals of 8 pixels of a row.
SLAM_INLINE FloatLanes Residuals(const BlockPixels& block, int u, int v, const PixelPlane& p) {
  const FloatLanes x = Lanes(block.x + (v * block.x_stride + u));
  const FloatLanes y = Lanes(block.y + (v * block.y_stride + u));
  const int i = v * block.stride + u;
  return (Lanes(block.q + i) - (p.a * x + p.b * y + p.c)) * Lanes(block.g + i) / p.grazing;
}
SLAM_INLINE float Residual(const BlockPixels& block, int u, int v, const PixelPlane& p) {
  const float x = block.x[v * block.x_stride + u], y = block.y[v * block.y_stride + u];
  const int i = v * block.stride + u;
  return (block.q[i] - (p.a * x + p.b * y + p.c)) * block.g[i] / p.grazing;
}

/// A whole block of 8 x 8.
SLAM_INLINE float Measure8(const BlockPixels& at, const PixelPlane& of, float* residuals) {
  const BlockPixels block = at;  // what is written cannot change these
  const PixelPlane plane = of;
  FloatLanes least = AllLanes(kNone);
  for (int v = 0; v < kLanes; ++v) {
    const FloatLanes r = Residuals(block, 0, v, plane);
    const FloatLanes out = Lanes(block.g + v * block.stride) > 0.0f ? r : AllLanes(kNone);
    Lanes(residuals + kLanes * v) = out;
    const FloatLanes size = Size(out);
    least = size < least ? size : least;
  }
  return LeastOf(least);
}

float MeasureAny(const BlockPixels& block, int count, const PixelPlane& plane,
                 float* residuals) {
  std::fill(residuals, residuals + count, kNone);
  float least = kNone;
  for (int v = 0; v < block.height; ++v) {
    for (int u = 0; u < block.width; ++u) {
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(v) * block.stride + u;
      if (!(block.g[i] > 0.0f)) continue;
      const float r = Residual(block, u, v, plane);
      residuals[v * block.size + u] = r;
      least = std::min(least, std::abs(r));
    }
  }
  return least;
}

/// A whole block of 8 x 8 with two pixels of the image to every side.
SLAM_INLINE void Bid8(const BlockPixels& at, const PixelPlane& of, float most_sigmas,
                      const float* residuals, float* bids) {
  const BlockPixels block = at;  // what is written cannot change these
  const PixelPlane plane = of;
  const FloatLanes most = AllLanes(most_sigmas * most_sigmas);
  float squares[kSide8 * kSide8 + kLanes], sums[kSide8 * kLanes];
  for (int v = 0; v < kSide8; ++v) {
    const FloatLanes left = Residuals(block, -kReach8, v - kReach8, plane);
    const FloatLanes right = Residuals(block, 4 - kReach8, v - kReach8, plane);
    const FloatLanes left2 = left * left, right2 = right * right;
    Lanes(squares + kSide8 * v) = most < left2 ? most : left2;
    Lanes(squares + kSide8 * v + 4) = most < right2 ? most : right2;
  }
  for (int v = 0; v < kSide8; ++v) {
    const float* s = squares + kSide8 * v;
    Lanes(sums + kLanes * v) =
        (((Lanes(s) + Lanes(s + 1)) + Lanes(s + 2)) + Lanes(s + 3)) + Lanes(s + 4);
  }
  for (int k = 0; k < kLanes * kLanes; k += kLanes) {
    const float* s = sums + k;
    const FloatLanes sum =
        (((Lanes(s) + Lanes(s + 8)) + Lanes(s + 16)) + Lanes(s + 24)) + Lanes(s + 32);
    Lanes(bids + k) =
        Size(Lanes(residuals + k)) < AllLanes(most_sigmas) ? sum : AllLanes(kNone);
  }
}

/// The same for other sizes and beside the image's border, beyond which there are zeros.
SLAM_INLINE void BidAny(const BlockPixels& block, int count, const PixelPlane& plane,
                        const BidWindow& window, const float* residuals, float* bids) {
  const float most = window.most_sigmas * window.most_sigmas;
  const int reach = window.reach, size = block.size;
  constexpr int kRows = kMostBlockSide_px + 2 * kMostBidReach_px;
  float squares[kRows], sums[kMostBlockSide_px * kRows];
  std::fill_n(squares, size + 2 * reach, 0.0f);
  std::fill_n(sums, size * (size + 2 * reach), 0.0f);
  for (int v = -window.top; v < block.height + window.bottom; ++v) {
    for (int u = -window.left; u < block.width + window.right; ++u) {
      const float r = Residual(block, u, v, plane);
      squares[u + reach] = std::min(r * r, most);
    }
    float* sum = sums + (v + reach) * size;
    for (int offset = 0; offset <= 2 * reach; ++offset)
      for (int u = 0; u < size; ++u) sum[u] += squares[u + offset];
  }
  std::fill(bids, bids + count, 0.0f);
  for (int v = 0; v < block.height; ++v) {
    for (int offset = 0; offset <= 2 * reach; ++offset)
      for (int u = 0; u < size; ++u) bids[v * size + u] += sums[(v + offset) * size + u];
  }
  for (int k = 0; k < count; ++k)
    bids[k] = std::abs(residuals[k]) < window.most_sigmas ? bids[k] : kNone;
}

}  // namespace

static_assert(DepthGrid::kCopiesBefore >= kMostBidReach_px &&
              DepthGrid::kRowCopies >= kMostBlockSide_px + 2 * kMostBidReach_px);

BlockPixels BlockAt(const DepthGrid& grid, int u, int v, int size) {
  const auto i = static_cast<std::size_t>(grid.Index(u, v));
  const bool shared = !grid.column_x.empty();
  const std::size_t row = static_cast<std::size_t>(v) * DepthGrid::kRowCopies;
  return {shared ? grid.column_x.data() + u : grid.x.data() + i,
          shared ? grid.row_y.data() + row + DepthGrid::kCopiesBefore : grid.y.data() + i,
          grid.q.data() + i,
          grid.g.data() + i,
          grid.width,
          shared ? 0 : grid.width,
          shared ? DepthGrid::kRowCopies : grid.width,
          std::min(size, grid.width - u),
          std::min(size, grid.height - v),
          size};
}

SLAM_LANES float MeasureBlock(const BlockPixels& block, int count, const PixelPlane& plane,
                              float* residuals) {
  const bool whole8 = block.size == kLanes && block.width == kLanes && block.height == kLanes;
  return whole8 ? Measure8(block, plane, residuals)
                : MeasureAny(block, count, plane, residuals);
}

SLAM_LANES void BidForBlock(const BlockPixels& block, int count, const PixelPlane& plane,
                            const BidWindow& window, const float* residuals, float* bids) {
  const bool usual = block.size == kLanes && block.width == kLanes && block.height == kLanes &&
                     window.reach == kReach8 && window.left == kReach8 &&
                     window.top == kReach8 && window.right == kReach8 &&
                     window.bottom == kReach8;
  if (usual) {
    Bid8(block, plane, window.most_sigmas, residuals, bids);
  } else {
    BidAny(block, count, plane, window, residuals, bids);
  }
}

SLAM_LANES void WriteOwners(const BlockPixels& block, const int* owners, std::int16_t* labels) {
  for (int v = 0; v < block.height; ++v) {
    std::int16_t* row = labels + static_cast<std::ptrdiff_t>(v) * block.stride;
    const int* from = owners + v * block.size;
    if (block.width == kLanes) {
      for (int u = 0; u < kLanes; ++u) row[u] = static_cast<std::int16_t>(from[u]);
    } else {
      for (int u = 0; u < block.width; ++u) row[u] = static_cast<std::int16_t>(from[u]);
    }
  }
}

SLAM_LANES void ReadOwners(const BlockPixels& block, int count, const std::int16_t* labels,
                           int* owners) {
  if (block.width < block.size || block.height < block.size)
    std::fill(owners, owners + count, static_cast<int>(kNoLabel));
  for (int v = 0; v < block.height; ++v) {
    const std::int16_t* row = labels + static_cast<std::ptrdiff_t>(v) * block.stride;
    int* to = owners + v * block.size;
    if (block.width == kLanes) {
      for (int u = 0; u < kLanes; ++u) to[u] = row[u];
    } else {
      for (int u = 0; u < block.width; ++u) to[u] = row[u];
    }
  }
}

/// GoToOne for rows of 8 labels.
SLAM_INLINE bool GoToOne8(const BlockPixels& block, const std::int16_t* from,
                          std::int16_t label, const std::int16_t* to, std::int16_t& only) {
  const EightLabels least = EightLabels{} + std::numeric_limits<std::int16_t>::max();
  const EightLabels of = EightLabels{} + label;
  EightLabels low = least, high = EightLabels{} + kNoLabel;
  for (int v = 0; v < block.height; ++v) {
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(v) * block.stride;
    const EightLabels own = Labels8(from + row) == of, now = Labels8(to + row);
    const EightLabels low_now = own ? now : least, high_now = own ? now : high;
    low = low_now < low ? low_now : low, high = high_now > high ? high_now : high;
  }
  std::int16_t first = low[0], last = high[0];
  for (int k = 1; k < kLanes; ++k)
    first = std::min<std::int16_t>(first, low[k]), last = std::max<std::int16_t>(last, high[k]);
  only = first;
  return first == last;
}

SLAM_LANES bool GoToOne(const BlockPixels& block, const std::int16_t* from, std::int16_t label,
                        const std::int16_t* to, std::int16_t& only) {
  if (block.width == kLanes) return GoToOne8(block, from, label, to, only);
  bool found = false;
  for (int v = 0; v < block.height; ++v) {
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(v) * block.stride;
    for (int u = 0; u < block.width; ++u) {
      if (from[row + u] != label) continue;
      if (found && to[row + u] != only) return false;
      only = to[row + u], found = true;
    }
  }
  return found;
}

}  // namespace slam
