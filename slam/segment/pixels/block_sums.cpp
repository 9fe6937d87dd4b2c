#include "slam/segment/pixels/block_sums.h"

#include <bit>
#include <cstddef>

#include "slam/base/lane_math.h"
#include "slam/segment/pixels/pixel_set_lanes.h"

namespace slam {
namespace {

using FourFloats = float __attribute__((vector_size(16)));
using FourInts = int __attribute__((vector_size(16)));
constexpr int kFour = 4;

SLAM_INLINE DoubleLanes InDouble(FourFloats v) {
  return DoubleLanes{static_cast<double>(v[0]), static_cast<double>(v[1]),
                     static_cast<double>(v[2]), static_cast<double>(v[3])};
}
SLAM_INLINE DoubleLanes Load4(const float* p) { return InDouble(Load<FourFloats>(p)); }

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

/// Four columns of a window, of pixels in a set.
/// @tparam kOneX  columns have one x
template <bool kOneX>
SLAM_INLINE FourSums SumFour(const BlockPixels& block, const BlockWindow& window, int u,
                             FourInts columns) {
  FourSums four;
  const std::ptrdiff_t v0 = window.v;
  const float *x = block.x + (v0 * block.x_stride + u), *y = block.y + (v0 * block.stride + u);
  const float *q = block.q + (v0 * block.stride + u), *g = block.g + (v0 * block.stride + u);
  columns >>= window.v;
#pragma GCC unroll 1  // sums stay in registers
  for (int v = 0; v < window.side; ++v) {
    const FourInts used = columns << 31 >> 31;
    const DoubleLanes g_used = InDouble((FourFloats)((FourInts)Load<FourFloats>(g) & used));
    if (kOneX) {
      four.AddColumn(Load4(y), Load4(q), g_used);
    } else {
      four.Add(Load4(x), Load4(y), Load4(q), g_used);
      x += block.x_stride;
    }
    columns >>= 1;
    y += block.stride, q += block.stride, g += block.stride;
  }
  if (kOneX) four.SetX(Load4(block.x + u));
  return four;
}

template <bool kOneX>
SLAM_INLINE PlaneSums SumWindow(const BlockPixels& block, PixelSet set,
                                const BlockWindow& window) {
  const IntLanes columns = ColumnsOf(set);
  const FourInts left = {columns[0], columns[1], columns[2], columns[3]},
                 right = {columns[4], columns[5], columns[6], columns[7]};
  FourSums sums;
  if (window.u == 0) sums = SumFour<kOneX>(block, window, 0, left);
  if (window.u + window.side == kBlock_px) sums += SumFour<kOneX>(block, window, kFour, right);
  return sums.Sum(std::popcount(set));
}

}  // namespace

SLAM_LANES PlaneSums SumOfSet(const BlockPixels& block, PixelSet set,
                              const BlockWindow& window) {
  return block.x_stride == 0 ? SumWindow<true>(block, set, window)
                             : SumWindow<false>(block, set, window);
}

SLAM_LANES bool HasJump(const BlockPixels& block, float max_sigmas, const BlockWindow& window) {
  const IntLanes column = {0, 1, 2, 3, 4, 5, 6, 7};
  const int end_u = window.u + window.side, end_v = window.v + window.side;
  const IntLanes inside = (column >= window.u) & (column < end_u);
  const IntLanes has_right = inside & (column + 1 < end_u);
  IntLanes jumps{};
  for (int v = window.v; v < end_v; ++v) {
    const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(v) * block.stride;
    const FloatLanes q = Lanes(block.q + i), g = Lanes(block.g + i);
    const FloatLanes q_right = {q[1], q[2], q[3], q[4], q[5], q[6], q[7], q[7]};
    const FloatLanes g_right = {g[1], g[2], g[3], g[4], g[5], g[6], g[7], g[7]};
    jumps |= has_right & (Abs(q - q_right) * g > max_sigmas) & (g_right > 0.0f);
    if (v + 1 == end_v) break;
    const FloatLanes q_below = Lanes(block.q + i + block.stride);
    const FloatLanes g_below = Lanes(block.g + i + block.stride);
    jumps |= inside & (Abs(q - q_below) * g > max_sigmas) & (g_below > 0.0f);
  }
  return AnyOf(jumps);
}

}  // namespace slam
