#include "slam/segment/block_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "slam/base/lane_math.h"
#include "slam/segment/pixel_set_lanes.h"

namespace slam {
namespace {

using FourFloats = float __attribute__((vector_size(16), aligned(4), may_alias));
using FourInts = int __attribute__((vector_size(16), aligned(4), may_alias));
constexpr int kFour = 4;

using FourMarks = std::uint8_t __attribute__((vector_size(4), aligned(1), may_alias));

SLAM_INLINE FourFloats Floats4(const float* p) {
  return *reinterpret_cast<const FourFloats*>(p);
}
SLAM_INLINE DoubleLanes InDouble(FourFloats v) {
  return DoubleLanes{static_cast<double>(v[0]), static_cast<double>(v[1]),
                     static_cast<double>(v[2]), static_cast<double>(v[3])};
}
SLAM_INLINE DoubleLanes Load4(const float* p) { return InDouble(Floats4(p)); }
SLAM_INLINE DoubleLanes AllDoubles(float v) { return DoubleLanes{} + static_cast<double>(v); }

using TwoDoubles = double __attribute__((vector_size(16)));
/// SumOf each of two.
SLAM_INLINE TwoDoubles SumsOf(DoubleLanes a, DoubleLanes b) {
  const TwoDoubles half_a = TwoDoubles{a[0], a[1]} + TwoDoubles{a[2], a[3]};
  const TwoDoubles half_b = TwoDoubles{b[0], b[1]} + TwoDoubles{b[2], b[3]};
  return TwoDoubles{half_a[0], half_b[0]} + TwoDoubles{half_a[1], half_b[1]};
}

/// PlaneSums of four columns of pixels, without their number.
struct FourSums {
  DoubleLanes w{}, wx{}, wy{}, wxx{}, wxy{}, wyy{}, wq{}, wqx{}, wqy{}, wqq{};

  SLAM_INLINE void Add(DoubleLanes x, DoubleLanes y, DoubleLanes q, DoubleLanes g) {
    const DoubleLanes vx = g * g * x;
    AddColumn(y, q, g);
    wx += vx, wxx += vx * x, wxy += vx * y, wqx += vx * q;
  }
  /// All but the sums with x.
  SLAM_INLINE void AddColumn(DoubleLanes y, DoubleLanes q, DoubleLanes g) {
    const DoubleLanes weight = g * g, vy = weight * y, vq = weight * q;
    w += weight, wy += vy, wyy += vy * y, wq += vq, wqy += vq * y, wqq += vq * q;
  }
  /// Those with x, of whole columns.
  SLAM_INLINE void SetX(DoubleLanes x) { wx = w * x, wxx = wx * x, wxy = wy * x, wqx = wq * x; }
  SLAM_INLINE void operator+=(const FourSums& o) {
    w += o.w, wx += o.wx, wy += o.wy, wxx += o.wxx, wxy += o.wxy, wyy += o.wyy;
    wq += o.wq, wqx += o.wqx, wqy += o.wqy, wqq += o.wqq;
  }
  SLAM_INLINE PlaneSums Sum(int n) const {
    const TwoDoubles ones = SumsOf(w, wq), xs = SumsOf(wx, wqx), ys = SumsOf(wy, wqy);
    const TwoDoubles squares = SumsOf(wxx, wyy), others = SumsOf(wxy, wqq);
    return {static_cast<double>(n),
            ones[0],
            xs[0],
            ys[0],
            squares[0],
            others[0],
            squares[1],
            ones[1],
            xs[1],
            ys[1],
            others[1]};
  }
};

/// Four columns of a block of 8 x 8, of pixels in a set or of all.
template <bool kOneX, bool kAll>
SLAM_INLINE FourSums SumFour(const BlockPixels& block, int u, FourInts columns) {
  FourSums four;
  const float *x = block.x + u, *y = block.y + u, *q = block.q + u, *g = block.g + u;
  FourInts set = columns << 31;
#pragma GCC unroll 1  // sums stay in registers
  for (int v = 0; v < kLanes; ++v) {
    FourFloats g_used = Floats4(g);
    if (!kAll) g_used = (FourFloats)((FourInts)g_used & (set >> 31));
    if (kOneX) {
      four.AddColumn(Load4(y), Load4(q), InDouble(g_used));
    } else {
      four.Add(Load4(x), Load4(y), Load4(q), InDouble(g_used));
      x += block.x_stride;
    }
    if (!kAll) columns >>= 1, set = columns << 31;
    y += block.y_stride, q += block.stride, g += block.stride;
  }
  if (kOneX) four.SetX(Load4(block.x + u));
  return four;
}

template <bool kOneX, bool kAll>
SLAM_INLINE PlaneSums Sum8(const BlockPixels& block, std::uint64_t set) {
  const IntLanes columns = ColumnsOf(set);
  const FourInts left = {columns[0], columns[1], columns[2], columns[3]},
                 right = {columns[4], columns[5], columns[6], columns[7]};
  FourSums sums = SumFour<kOneX, kAll>(block, 0, left);
  sums += SumFour<kOneX, kAll>(block, kFour, right);
  return sums.Sum(std::popcount(set));
}

PlaneSums SumAny(const BlockPixels& block, ConstPixelSet set) {
  PlaneSums out;
  for (int v = 0; v < block.height; ++v) {
    for (int u = 0; u < block.width; ++u) {
      if (!IsInSet(set, block.size, u, v)) continue;
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(v) * block.stride + u;
      const double g = static_cast<double>(block.g[i]);
      out.Add(static_cast<double>(block.x[v * block.x_stride + u]),
              static_cast<double>(block.y[v * block.y_stride + u]),
              static_cast<double>(block.q[i]), g * g);
    }
  }
  return out;
}

/// g of four pixels that are not taken, 0 for the others.
SLAM_INLINE FourFloats Weights(const float* g, const std::uint8_t* taken) {
  const auto four =
      __builtin_convertvector(*reinterpret_cast<const FourMarks*>(taken), FourInts);
  const FourInts used = four == 0;
  return (FourFloats)((FourInts)Floats4(g) & used);
}

/// Sums of the measured pixels that are not taken; columns four at a time, then the rest.
SLAM_INLINE PlaneSums SumNotTaken(const BlockPixels& block, const std::uint8_t* taken) {
  FourSums fours;
  FourInts n{};
  const bool whole_columns = block.x_stride == 0;  // each of one x, and rows of one y
  const int whole = block.width / kFour * kFour;
  for (int u = 0; u < whole; u += kFour) {
    FourSums four;
    for (int v = 0; v < block.height; ++v) {
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(v) * block.stride + u;
      const FourFloats used = Weights(block.g + i, taken + i);
      n -= used > 0.0f;
      const DoubleLanes g = InDouble(used), q = Load4(block.q + i);
      if (whole_columns) {
        four.AddColumn(AllDoubles(block.y[v * block.y_stride]), q, g);
      } else {
        four.Add(Load4(block.x + (v * block.x_stride + u)),
                 Load4(block.y + (v * block.y_stride + u)), q, g);
      }
    }
    if (whole_columns) four.SetX(Load4(block.x + u));
    fours += four;
  }
  PlaneSums out = fours.Sum((n[0] + n[1]) + (n[2] + n[3]));
  for (int v = 0; v < block.height; ++v) {
    for (int u = whole; u < block.width; ++u) {
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(v) * block.stride + u;
      const double g = static_cast<double>(block.g[i]);
      if (!(g > 0.0) || taken[i] != 0) continue;
      out.Add(static_cast<double>(block.x[v * block.x_stride + u]),
              static_cast<double>(block.y[v * block.y_stride + u]),
              static_cast<double>(block.q[i]), g * g);
    }
  }
  return out;
}

SLAM_INLINE bool HasJump8(const BlockPixels& block, float max_sigmas) {
  IntLanes jumps{};
  for (int v = 0; v < kLanes; ++v) {
    const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(v) * block.stride;
    const FloatLanes q = Lanes(block.q + i), g = Lanes(block.g + i);
    // The last pixel beside itself: no jump.
    const FloatLanes q_right = {q[1], q[2], q[3], q[4], q[5], q[6], q[7], q[7]};
    const FloatLanes g_right = {g[1], g[2], g[3], g[4], g[5], g[6], g[7], g[7]};
    jumps |= (Abs(q - q_right) * g > max_sigmas) & (g_right > 0.0f);
    if (v + 1 == kLanes) break;
    const FloatLanes q_below = Lanes(block.q + i + block.stride);
    const FloatLanes g_below = Lanes(block.g + i + block.stride);
    jumps |= (Abs(q - q_below) * g > max_sigmas) & (g_below > 0.0f);
  }
  return AnyOf(jumps);
}

bool HasJumpAny(const BlockPixels& block, float max_sigmas) {
  const auto jump = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    return block.g[j] > 0.0f && std::abs(block.q[i] - block.q[j]) * block.g[i] > max_sigmas;
  };
  for (int v = 0; v < block.height; ++v) {
    for (int u = 0; u < block.width; ++u) {
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(v) * block.stride + u;
      if (u + 1 < block.width && jump(i, i + 1)) return true;
      if (v + 1 < block.height && jump(i, i + block.stride)) return true;
    }
  }
  return false;
}

}  // namespace

SLAM_LANES PlaneSums SumBlock(const BlockPixels& block, ConstPixelSet measured) {
  if (!IsWhole8(block)) return SumAny(block, measured);
  return block.x_stride == 0 ? Sum8<true, true>(block, *measured)
                             : Sum8<false, true>(block, *measured);
}

SLAM_LANES PlaneSums SumOfSet(const BlockPixels& block, ConstPixelSet set) {
  if (!IsWhole8(block)) return SumAny(block, set);
  return block.x_stride == 0 ? Sum8<true, false>(block, *set) : Sum8<false, false>(block, *set);
}

SLAM_LANES PlaneSums SumFree(const BlockPixels& block, const std::uint8_t* taken) {
  return SumNotTaken(block, taken);
}

SLAM_LANES void CountFree(const float* g, const std::uint8_t* taken, int stride, int width,
                          int height, std::uint8_t* __restrict counts) {
  std::fill(counts, counts + width, std::uint8_t{0});
  for (int v = 0; v < height; ++v) {
    const float* g_row = g + static_cast<std::ptrdiff_t>(v) * stride;
    const std::uint8_t* taken_row = taken + static_cast<std::ptrdiff_t>(v) * stride;
    for (int u = 0; u < width; ++u) {
      const int free = (taken_row[u] == 0 ? 1 : 0) & (g_row[u] > 0.0f ? 1 : 0);
      counts[u] = static_cast<std::uint8_t>(counts[u] + free);
    }
  }
}

SLAM_LANES bool HasJump(const BlockPixels& block, float max_sigmas) {
  return block.width == kLanes && block.height == kLanes ? HasJump8(block, max_sigmas)
                                                         : HasJumpAny(block, max_sigmas);
}

}  // namespace slam
