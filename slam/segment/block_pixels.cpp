#include "slam/segment/block_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "slam/base/lane_math.h"
#include "slam/segment/pixel_set_lanes.h"

namespace slam {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr int kReach8 = 2;                    // pixels; the usual reach of a cost
constexpr int kSide8 = kLanes + 2 * kReach8;  // pixels; what the costs of a block of 8 look at

SLAM_INLINE bool HasColumnsOfOneX(const BlockPixels& block) { return block.x_stride == 0; }

/// How far 8 pixels of a row at a time are from a plane, in sigmas of a surface that is seen
/// frontally: what is compared with it is scaled by the grazing factor instead.
/// @tparam kOneX  columns have one x
template <bool kOneX>
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
        y_stride_(block.y_stride),
        a_(AllLanes(p.a)),
        b_(AllLanes(p.b)),
        c_(AllLanes(p.c)) {
    if (kOneX) ax_ = a_ * Lanes(x_);
  }
  SLAM_INLINE FloatLanes At(std::ptrdiff_t v) const {
    const FloatLanes ax = kOneX ? ax_ : a_ * Lanes(x_ + v * x_stride_);
    const std::ptrdiff_t y_stride = kOneX ? DepthGrid::kRowCopies : y_stride_;
    const FloatLanes predicted = ax + b_ * Lanes(y_ + v * y_stride) + c_;
    return (Lanes(q_ + v * stride_) - predicted) * Lanes(g_ + v * stride_);
  }

 private:
  const float *x_, *y_, *q_, *g_;
  std::ptrdiff_t stride_, x_stride_, y_stride_;
  FloatLanes a_, b_, c_, ax_{};
};

SLAM_INLINE float Error(const BlockPixels& block, int u, int v, const PixelPlane& p) {
  const float x = block.x[v * block.x_stride + u], y = block.y[v * block.y_stride + u];
  const int i = v * block.stride + u;
  return (block.q[i] - (p.a * x + p.b * y + p.c)) * block.g[i];
}

template <bool kOneX>
SLAM_INLINE void FindNear8(const BlockPixels& block, const PixelPlane& plane,
                           std::uint64_t measured, float near_sigmas, float wide_sigmas,
                           PixelSet near, PixelSet wide) {
  const RowErrors<kOneX> errors(block, 0, plane);
  const FloatLanes near_lanes = AllLanes(near_sigmas * plane.grazing),
                   wide_lanes = AllLanes(wide_sigmas * plane.grazing);
  RowsOfSet near_rows, wide_rows;
#pragma GCC unroll 8
  for (int v = kLanes - 1; v >= 0; --v) {
    const FloatLanes distance = Abs(errors.At(v));
    near_rows.Add(distance < near_lanes);
    wide_rows.Add(distance < wide_lanes);
  }
  *near = near_rows.Set() & measured;
  *wide = wide_rows.Set() & measured;
}

void FindNearAny(const BlockPixels& block, const PixelPlane& plane, ConstPixelSet measured,
                 float near_sigmas, float wide_sigmas, PixelSet near, PixelSet wide) {
  std::fill_n(near, WordsOfSet(block.size), std::uint64_t{0});
  std::fill_n(wide, WordsOfSet(block.size), std::uint64_t{0});
  for (int v = 0; v < block.height; ++v) {
    for (int u = 0; u < block.width; ++u) {
      if (!IsInSet(measured, block.size, u, v)) continue;
      const float distance = std::abs(Error(block, u, v, plane));
      if (distance < near_sigmas * plane.grazing) PutInSet(near, block.size, u, v);
      if (distance < wide_sigmas * plane.grazing) PutInSet(wide, block.size, u, v);
    }
  }
}

/// Adds eight floats to four sums.
SLAM_INLINE void AddTo(DoubleLanes& sum, FloatLanes v) {
  sum += DoubleLanes{static_cast<double>(v[0]), static_cast<double>(v[1]),
                     static_cast<double>(v[2]), static_cast<double>(v[3])};
  sum += DoubleLanes{static_cast<double>(v[4]), static_cast<double>(v[5]),
                     static_cast<double>(v[6]), static_cast<double>(v[7])};
}

template <bool kOneX>
SLAM_INLINE double SumErrors8(const BlockPixels& block, const PixelPlane& plane,
                              std::uint64_t set) {
  const RowErrors<kOneX> errors(block, 0, plane);
  const IntLanes columns = ColumnsOf(set);
  DoubleLanes sum{};
#pragma GCC unroll 8
  for (int v = 0; v < kLanes; ++v)
    AddTo(sum, (FloatLanes)((IntLanes)errors.At(v) & RowOf(columns, v)));
  return SumOf(sum);
}

double SumErrors(const BlockPixels& block, const PixelPlane& plane, ConstPixelSet set) {
  double sum = 0.0;
  for (int v = 0; v < block.height; ++v) {
    for (int u = 0; u < block.width; ++u) {
      if (IsInSet(set, block.size, u, v)) sum += static_cast<double>(Error(block, u, v, plane));
    }
  }
  return sum;
}

template <bool kOneX>
SLAM_INLINE void LowerToDistance8(const BlockPixels& block, const PixelPlane& plane,
                                  float* nearest) {
  const RowErrors<kOneX> errors(block, 0, plane);
  const FloatLanes scale = AllLanes(1.0f / plane.grazing);
#pragma GCC unroll 8
  for (int v = 0; v < kLanes; ++v) {
    const FloatLanes distance = Abs(errors.At(v)) * scale;
    FloatLanes& entry = Lanes(nearest + kLanes * v);
    entry = distance < entry ? distance : entry;
  }
}

template <bool kOneX>
SLAM_INLINE double SumGains8(const BlockPixels& block, const PixelPlane& plane,
                             std::uint64_t set, const float* nearest) {
  const RowErrors<kOneX> errors(block, 0, plane);
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

/// A whole block of 8 x 8 with two pixels of the image to every side.
template <bool kOneX>
SLAM_INLINE void FindCosts8(const BlockPixels& block, const PixelPlane& plane, float max_sigmas,
                            std::uint64_t near, float* costs) {
  const RowErrors<kOneX> lefts(block, -kReach8, plane), rights(block, 4 - kReach8, plane);
  const float max_error = max_sigmas * plane.grazing;
  const FloatLanes max_square = AllLanes(max_error * max_error);
  float squares[kSide8 * kSide8 + kLanes], sums[kSide8 * kLanes];
  for (int v = 0; v < kSide8; ++v) {
    const FloatLanes left = lefts.At(v - kReach8), right = rights.At(v - kReach8);
    const FloatLanes left2 = left * left, right2 = right * right;
    Lanes(squares + kSide8 * v) = max_square < left2 ? max_square : left2;
    Lanes(squares + kSide8 * v + 4) = max_square < right2 ? max_square : right2;
  }
  for (int v = 0; v < kSide8; ++v) {
    const float* s = squares + kSide8 * v;
    Lanes(sums + kLanes * v) =
        (((Lanes(s) + Lanes(s + 1)) + Lanes(s + 2)) + Lanes(s + 3)) + Lanes(s + 4);
  }
  const IntLanes columns = ColumnsOf(near);
  const FloatLanes scale = AllLanes(1.0f / (plane.grazing * plane.grazing));
#pragma GCC unroll 8
  for (int v = 0; v < kLanes; ++v) {
    const float* s = sums + kLanes * v;
    const FloatLanes sum =
        (((Lanes(s) + Lanes(s + 8)) + Lanes(s + 16)) + Lanes(s + 24)) + Lanes(s + 32);
    Lanes(costs + kLanes * v) = RowOf(columns, v) ? sum * scale : AllLanes(kNone);
  }
}

/// The same for other sizes and beside the image's border, beyond which there are zeros.
SLAM_INLINE void FindCostsAny(const BlockPixels& block, const PixelPlane& plane,
                              const CostWindow& window, ConstPixelSet near, float* costs) {
  const float max_error = window.max_sigmas * plane.grazing, max_square = max_error * max_error;
  const float scale = 1.0f / (plane.grazing * plane.grazing);
  const int reach = window.reach, size = block.size;
  const std::size_t count = EntriesOfBlock(size);
  constexpr int kRows = kMaxBlockSide_px + 2 * kMaxCostReach_px;
  float squares[kRows], sums[kMaxBlockSide_px * kRows];
  std::fill_n(squares, size + 2 * reach, 0.0f);
  std::fill_n(sums, size * (size + 2 * reach), 0.0f);
  for (int v = -window.top; v < block.height + window.bottom; ++v) {
    for (int u = -window.left; u < block.width + window.right; ++u) {
      const float r = Error(block, u, v, plane);
      squares[u + reach] = std::min(r * r, max_square);
    }
    float* sum = sums + (v + reach) * size;
    for (int offset = 0; offset <= 2 * reach; ++offset)
      for (int u = 0; u < size; ++u) sum[u] += squares[u + offset];
  }
  std::fill(costs, costs + count, 0.0f);
  for (int v = 0; v < block.height; ++v) {
    for (int offset = 0; offset <= 2 * reach; ++offset)
      for (int u = 0; u < size; ++u) costs[v * size + u] += sums[(v + offset) * size + u];
  }
  std::fill(costs + size * size, costs + count, kNone);
  for (int v = 0; v < size; ++v) {
    for (int u = 0; u < size; ++u) {
      float& cost = costs[v * size + u];
      cost = IsInSet(near, size, u, v) ? cost * scale : kNone;
    }
  }
}

}  // namespace

SLAM_LANES void FindMeasured(const BlockPixels& block, PixelSet measured) {
  if (IsWhole8(block)) {
    RowsOfSet rows;
#pragma GCC unroll 8
    for (int v = kLanes - 1; v >= 0; --v)
      rows.Add(Lanes(block.g + static_cast<std::ptrdiff_t>(v) * block.stride) > 0.0f);
    *measured = rows.Set();
    return;
  }
  std::fill_n(measured, WordsOfSet(block.size), std::uint64_t{0});
  for (int v = 0; v < block.height; ++v) {
    for (int u = 0; u < block.width; ++u) {
      if (block.g[static_cast<std::ptrdiff_t>(v) * block.stride + u] > 0.0f)
        PutInSet(measured, block.size, u, v);
    }
  }
}

SLAM_LANES int FindNear(const BlockPixels& block, const PixelPlane& plane,
                        ConstPixelSet measured, float near_sigmas, float wide_sigmas,
                        PixelSet near, PixelSet wide) {
  if (!IsWhole8(block)) {
    FindNearAny(block, plane, measured, near_sigmas, wide_sigmas, near, wide);
  } else if (HasColumnsOfOneX(block)) {
    FindNear8<true>(block, plane, *measured, near_sigmas, wide_sigmas, near, wide);
  } else {
    FindNear8<false>(block, plane, *measured, near_sigmas, wide_sigmas, near, wide);
  }
  return CountOf(near, WordsOfSet(block.size));
}

SLAM_LANES double SumResiduals(const BlockPixels& block, const PixelPlane& plane,
                               ConstPixelSet set) {
  const double sum = !IsWhole8(block)          ? SumErrors(block, plane, set)
                     : HasColumnsOfOneX(block) ? SumErrors8<true>(block, plane, *set)
                                               : SumErrors8<false>(block, plane, *set);
  return sum / static_cast<double>(plane.grazing);
}

SLAM_LANES void LowerToDistance(const BlockPixels& block, const PixelPlane& plane,
                                float* nearest) {
  if (IsWhole8(block)) {
    HasColumnsOfOneX(block) ? LowerToDistance8<true>(block, plane, nearest)
                            : LowerToDistance8<false>(block, plane, nearest);
    return;
  }
  for (int v = 0; v < block.height; ++v) {
    for (int u = 0; u < block.width; ++u) {
      float& entry = nearest[v * block.size + u];
      entry = std::min(entry, std::abs(Error(block, u, v, plane)) * (1.0f / plane.grazing));
    }
  }
}

SLAM_LANES double SumGains(const BlockPixels& block, const PixelPlane& plane, ConstPixelSet set,
                           const float* nearest) {
  if (IsWhole8(block)) {
    return HasColumnsOfOneX(block) ? SumGains8<true>(block, plane, *set, nearest)
                                   : SumGains8<false>(block, plane, *set, nearest);
  }
  double sum = 0.0;
  for (int v = 0; v < block.height; ++v) {
    for (int u = 0; u < block.width; ++u) {
      if (!IsInSet(set, block.size, u, v)) continue;
      const float own = Error(block, u, v, plane) * (1.0f / plane.grazing),
                  next = nearest[v * block.size + u];
      sum += static_cast<double>(next * next - own * own);
    }
  }
  return sum;
}

SLAM_LANES void FindCosts(const BlockPixels& block, const PixelPlane& plane,
                          const CostWindow& window, ConstPixelSet near, float* costs) {
  const bool usual = IsWhole8(block) && window.reach == kReach8 && window.left == kReach8 &&
                     window.top == kReach8 && window.right == kReach8 &&
                     window.bottom == kReach8;
  if (!usual) {
    FindCostsAny(block, plane, window, near, costs);
  } else if (HasColumnsOfOneX(block)) {
    FindCosts8<true>(block, plane, window.max_sigmas, *near, costs);
  } else {
    FindCosts8<false>(block, plane, window.max_sigmas, *near, costs);
  }
}

}  // namespace slam
