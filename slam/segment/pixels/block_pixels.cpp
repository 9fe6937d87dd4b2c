#include "slam/segment/pixels/block_pixels.h"

#include <bit>
#include <cstddef>
#include <limits>

#include "slam/base/lane_math.h"
#include "slam/segment/pixels/pixel_set_lanes.h"

namespace slam {
namespace {

constexpr float kNotNear = std::numeric_limits<float>::infinity();
constexpr int kSide_px = kBlock_px + 2 * kVoteReach_px;  // what the costs of a block look at
static_assert(kBlock_px == kLanes && kSide_px == kLanes + 4, "two overlapping reads a row");

/// How far 8 pixels of a row at a time are from a plane, in sigmas of a surface that is seen
/// frontally: what is compared with it is scaled by the grazing factor instead.
class RowErrors {
 public:
  /// From column u on.
  SLAM_INLINE RowErrors(const BlockPixels& block, int u, const PixelPlane& p)
      : x_(block.x + u),
        y_(block.y + u),
        q_(block.q + u),
        g_(block.g + u),
        stride_(block.stride),
        x_stride_(block.x_stride),
        a_(AllLanes(p.a)),
        b_(AllLanes(p.b)),
        c_(AllLanes(p.c)) {}
  SLAM_INLINE FloatLanes At(std::ptrdiff_t v) const {
    const FloatLanes predicted =
        a_ * Lanes(x_ + v * x_stride_) + b_ * Lanes(y_ + v * stride_) + c_;
    return (Lanes(q_ + v * stride_) - predicted) * Lanes(g_ + v * stride_);
  }

 private:
  const float *x_, *y_, *q_, *g_;
  std::ptrdiff_t stride_, x_stride_;
  FloatLanes a_, b_, c_;
};

using FourFloats = float __attribute__((vector_size(16)));
using FourInts = int __attribute__((vector_size(16)));
constexpr int kFour = 4;

SLAM_INLINE DoubleLanes InDouble(FourFloats v) {
  return DoubleLanes{static_cast<double>(v[0]), static_cast<double>(v[1]),
                     static_cast<double>(v[2]), static_cast<double>(v[3])};
}
SLAM_INLINE DoubleLanes Load4(const float* p) { return InDouble(Load<FourFloats>(p)); }

/// Adds eight floats to four sums.
SLAM_INLINE void AddTo(DoubleLanes& sum, FloatLanes v) {
  sum += InDouble(FourFloats{v[0], v[1], v[2], v[3]});
  sum += InDouble(FourFloats{v[4], v[5], v[6], v[7]});
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
    return {static_cast<double>(n),
            SumOf(w),
            SumOf(wx),
            SumOf(wy),
            SumOf(wxx),
            SumOf(wxy),
            SumOf(wyy),
            SumOf(wq),
            SumOf(wqx),
            SumOf(wqy),
            SumOf(wqq)};
  }
};

/// The four columns of a block from u on, of pixels in a set.
/// @tparam kOneX  columns have one x
template <bool kOneX>
SLAM_INLINE FourSums SumFour(const BlockPixels& block, int u, FourInts columns) {
  FourSums four;
  const float *x = block.x + u, *y = block.y + u, *q = block.q + u, *g = block.g + u;
#pragma GCC unroll 1  // sums stay in registers
  for (int v = 0; v < kBlock_px; ++v) {
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
SLAM_INLINE PlaneSums SumBlock(const BlockPixels& block, PixelSet set) {
  constexpr PixelSet kLeft = 0xffffffff;
  const IntLanes columns = ColumnsOf(set);
  const FourInts left = {columns[0], columns[1], columns[2], columns[3]},
                 right = {columns[4], columns[5], columns[6], columns[7]};
  FourSums sums;
  if ((set & kLeft) != 0) sums = SumFour<kOneX>(block, 0, left);
  if ((set & ~kLeft) != 0) sums += SumFour<kOneX>(block, kFour, right);
  return sums.Sum(std::popcount(set));
}

/// Where eight pixels from one place on differ from those from another place on.
SLAM_INLINE IntLanes Jumps(const BlockPixels& block, std::ptrdiff_t i, std::ptrdiff_t j,
                           float max_sigmas) {
  const FloatLanes by = Abs(Lanes(block.q + i) - Lanes(block.q + j)) * Lanes(block.g + i);
  return (by > max_sigmas) & (Lanes(block.g + j) > 0.0f);
}

}  // namespace

SLAM_LANES PixelSet FindMeasured(const BlockPixels& block) {
  RowsOfSet rows;
#pragma GCC unroll 8
  for (int v = kLanes - 1; v >= 0; --v)
    rows.Add(Lanes(block.g + static_cast<std::ptrdiff_t>(v) * block.stride) > 0.0f);
  return rows.Set();
}

SLAM_LANES NearPixels FindNear(const BlockPixels& block, const PixelPlane& plane,
                               PixelSet measured, float near_sigmas, float wide_sigmas) {
  const RowErrors errors(block, 0, plane);
  const FloatLanes near = AllLanes(near_sigmas * plane.grazing),
                   wide = AllLanes(wide_sigmas * plane.grazing);
  RowsOfSet near_rows, wide_rows;
#pragma GCC unroll 8
  for (int v = kLanes - 1; v >= 0; --v) {
    const FloatLanes distance = Abs(errors.At(v));
    near_rows.Add(distance < near);
    wide_rows.Add(distance < wide);
  }
  return {near_rows.Set() & measured, wide_rows.Set() & measured};
}

SLAM_LANES double SumResiduals(const BlockPixels& block, const PixelPlane& plane,
                               PixelSet set) {
  const RowErrors errors(block, 0, plane);
  const IntLanes columns = ColumnsOf(set);
  DoubleLanes sum{};
#pragma GCC unroll 8
  for (int v = 0; v < kLanes; ++v)
    AddTo(sum, (FloatLanes)((IntLanes)errors.At(v) & RowOf(columns, v)));
  return SumOf(sum) / static_cast<double>(plane.grazing);
}

SLAM_LANES void LowerToDistance(const BlockPixels& block, const PixelPlane& plane,
                                float* nearest) {
  const RowErrors errors(block, 0, plane);
  const FloatLanes scale = AllLanes(1.0f / plane.grazing);
#pragma GCC unroll 8
  for (int v = 0; v < kLanes; ++v) {
    const FloatLanes distance = Abs(errors.At(v)) * scale;
    const FloatLanes entry = Lanes(nearest + kLanes * v);
    Store(distance < entry ? distance : entry, nearest + kLanes * v);
  }
}

SLAM_LANES double SumGains(const BlockPixels& block, const PixelPlane& plane, PixelSet set,
                           const float* nearest) {
  const RowErrors errors(block, 0, plane);
  const IntLanes columns = ColumnsOf(set);
  const FloatLanes scale = AllLanes(1.0f / plane.grazing);
  DoubleLanes sum{};
#pragma GCC unroll 8
  for (int v = 0; v < kLanes; ++v) {
    const FloatLanes own = errors.At(v) * scale, next = Lanes(nearest + kLanes * v);
    AddTo(sum, (FloatLanes)((IntLanes)(next * next - own * own) & RowOf(columns, v)));
  }
  return SumOf(sum);
}

SLAM_LANES void FindCosts(const BlockPixels& block, const PixelPlane& plane, float max_sigmas,
                          PixelSet near, float* costs) {
  // Squared errors of the block and of what lies around it.
  const RowErrors lefts(block, -kVoteReach_px, plane), rights(block, 4 - kVoteReach_px, plane);
  const float max_error = max_sigmas * plane.grazing;
  const FloatLanes max_square = AllLanes(max_error * max_error);
  float squares[kSide_px * kSide_px + kLanes], sums[kSide_px * kLanes];
  for (int v = 0; v < kSide_px; ++v) {
    const FloatLanes left = lefts.At(v - kVoteReach_px), right = rights.At(v - kVoteReach_px);
    const FloatLanes left2 = left * left, right2 = right * right;
    Store(max_square < left2 ? max_square : left2, squares + kSide_px * v);
    Store(max_square < right2 ? max_square : right2, squares + kSide_px * v + 4);
  }

  // Their sums over five columns, then over five rows.
  for (int v = 0; v < kSide_px; ++v) {
    const float* s = squares + kSide_px * v;
    const FloatLanes sum =
        (((Lanes(s) + Lanes(s + 1)) + Lanes(s + 2)) + Lanes(s + 3)) + Lanes(s + 4);
    Store(sum, sums + kLanes * v);
  }
  const IntLanes columns = ColumnsOf(near);
  const FloatLanes scale = AllLanes(1.0f / (plane.grazing * plane.grazing));
#pragma GCC unroll 8
  for (int v = 0; v < kLanes; ++v) {
    const float* s = sums + kLanes * v;
    const FloatLanes sum =
        (((Lanes(s) + Lanes(s + 8)) + Lanes(s + 16)) + Lanes(s + 24)) + Lanes(s + 32);
    Store(RowOf(columns, v) ? sum * scale : AllLanes(kNotNear), costs + kLanes * v);
  }
}

SLAM_LANES PlaneSums SumOfSet(const BlockPixels& block, PixelSet set) {
  return block.x_stride == 0 ? SumBlock<true>(block, set) : SumBlock<false>(block, set);
}

SLAM_LANES bool HasJump(const BlockPixels& block, float max_sigmas, PixelSet within) {
  const IntLanes has_right = ColumnsOf(within & within >> kBlock_px);
  const IntLanes has_below = ColumnsOf(within & within >> 1 & ~kLastRow);
  IntLanes jumps{};
  for (int v = 0; v < kBlock_px; ++v) {
    const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(v) * block.stride;
    jumps |= RowOf(has_right, v) & Jumps(block, i, i + 1, max_sigmas);
    jumps |= RowOf(has_below, v) & Jumps(block, i, i + block.stride, max_sigmas);
  }
  return AnyOf(jumps);
}

}  // namespace slam
