#include "slam/extract/block_sums.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "slam/base/lanes.h"

#define PAS_INLINE [[gnu::always_inline]] inline

namespace slam {
namespace {

using FourFloats = float __attribute__((vector_size(16), aligned(4), may_alias));
using FourInts = int __attribute__((vector_size(16), aligned(4), may_alias));
constexpr int kFour = 4;

/// PlaneSums of four columns of pixels.
struct FourSums {
  DoubleLanes n{}, w{}, wx{}, wy{}, wxx{}, wxy{}, wyy{}, wq{}, wqx{}, wqy{}, wqq{};
};

PAS_INLINE DoubleLanes Load4(const float* p) {
  return __builtin_convertvector(*reinterpret_cast<const FourFloats*>(p), DoubleLanes);
}

PAS_INLINE void Add4(const BlockPixels& block, int u, int v, DoubleLanes g, FourSums& sums) {
  const DoubleLanes x = Load4(block.x + (v * block.x_stride + u));
  const DoubleLanes y = Load4(block.y + (v * block.y_stride + u));
  const DoubleLanes q = Load4(block.q + (v * block.stride + u));
  const DoubleLanes w = g * g, vx = w * x, vy = w * y, vq = w * q;
  sums.n += g > 0.0 ? DoubleLanes{} + 1.0 : DoubleLanes{};
  sums.w += w, sums.wx += vx, sums.wy += vy, sums.wq += vq;
  sums.wxx += vx * x, sums.wxy += vx * y, sums.wyy += vy * y;
  sums.wqx += vq * x, sums.wqy += vq * y, sums.wqq += vq * q;
}

PAS_INLINE double SumOf(DoubleLanes v) { return (v[0] + v[2]) + (v[1] + v[3]); }

/// Sums of the pixels that have `value` in `marks` (null: of all); columns four at a time, then
/// the rest.
template <typename Mark>
PAS_INLINE PlaneSums Sum(const BlockPixels& block, const Mark* marks, Mark value) {
  FourSums four;
  const int whole = block.width / kFour * kFour;
  for (int u = 0; u < whole; u += kFour) {
    for (int v = 0; v < block.height; ++v) {
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(v) * block.stride + u;
      const FourFloats g = *reinterpret_cast<const FourFloats*>(block.g + i);
      FourInts used = FourInts{} - 1;
      if (marks != nullptr) {
        const FourInts four_marks{marks[i], marks[i + 1], marks[i + 2], marks[i + 3]};
        used = four_marks == static_cast<int>(value);
      }
      const auto kept = (FourFloats)((FourInts)g & used);
      Add4(block, u, v, __builtin_convertvector(kept, DoubleLanes), four);
    }
  }
  PlaneSums out;
  out.n = SumOf(four.n), out.w = SumOf(four.w), out.wx = SumOf(four.wx);
  out.wy = SumOf(four.wy), out.wxx = SumOf(four.wxx), out.wxy = SumOf(four.wxy);
  out.wyy = SumOf(four.wyy), out.wq = SumOf(four.wq), out.wqx = SumOf(four.wqx);
  out.wqy = SumOf(four.wqy), out.wqq = SumOf(four.wqq);
  for (int v = 0; v < block.height; ++v) {
    for (int u = whole; u < block.width; ++u) {
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(v) * block.stride + u;
      const double g = static_cast<double>(block.g[i]);
      if (!(g > 0.0) || (marks != nullptr && marks[i] != value)) continue;
      out.Add(static_cast<double>(block.x[v * block.x_stride + u]),
              static_cast<double>(block.y[v * block.y_stride + u]),
              static_cast<double>(block.q[i]), g * g);
    }
  }
  return out;
}

PAS_INLINE FloatLanes Size(FloatLanes r) { return (FloatLanes)((IntLanes)r & 0x7fffffff); }

PAS_INLINE bool HasJump8(const BlockPixels& block, float most_sigmas) {
  IntLanes jumps{};
  for (int v = 0; v < kLanes; ++v) {
    const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(v) * block.stride;
    const FloatLanes q = Lanes(block.q + i), g = Lanes(block.g + i);
    // The last pixel beside itself: no jump.
    const FloatLanes q_right = {q[1], q[2], q[3], q[4], q[5], q[6], q[7], q[7]};
    const FloatLanes g_right = {g[1], g[2], g[3], g[4], g[5], g[6], g[7], g[7]};
    jumps |= (Size(q - q_right) * g > most_sigmas) & (g_right > 0.0f);
    if (v + 1 == kLanes) break;
    const FloatLanes q_below = Lanes(block.q + i + block.stride);
    const FloatLanes g_below = Lanes(block.g + i + block.stride);
    jumps |= (Size(q - q_below) * g > most_sigmas) & (g_below > 0.0f);
  }
  int any = 0;
  for (int k = 0; k < kLanes; ++k) any |= jumps[k];
  return any != 0;
}

bool HasJumpAny(const BlockPixels& block, float most_sigmas) {
  const auto jump = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    return block.g[j] > 0.0f && std::abs(block.q[i] - block.q[j]) * block.g[i] > most_sigmas;
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

SLAM_LANES PlaneSums SumBlock(const BlockPixels& block) {
  return Sum<std::uint8_t>(block, nullptr, 0);
}

SLAM_LANES PlaneSums SumLabelled(const BlockPixels& block, const std::int16_t* labels,
                                 std::int16_t label) {
  return Sum(block, labels, label);
}

void SumTile(const BlockPixels& block, const std::int16_t* labels,
             std::vector<PlaneSums>& sums) {
  std::int16_t label = kNoLabel;  // summed last
  for (int summed = 0; summed < block.width * block.height; ++summed) {
    // Labels in order: the least that is greater than the last one.
    int next = std::numeric_limits<std::int16_t>::max() + 1;
    for (int v = 0; v < block.height; ++v) {
      const std::int16_t* row = labels + static_cast<std::ptrdiff_t>(v) * block.stride;
      for (int u = 0; u < block.width; ++u)
        next = row[u] > label && row[u] < next ? row[u] : next;
    }
    if (next > std::numeric_limits<std::int16_t>::max()) return;
    label = static_cast<std::int16_t>(next);
    sums[static_cast<std::size_t>(label)] += SumLabelled(block, labels, label);
  }
}

SLAM_LANES PlaneSums SumFree(const BlockPixels& block, const std::uint8_t* taken) {
  return Sum<std::uint8_t>(block, taken, 0);
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

SLAM_LANES bool HasJump(const BlockPixels& block, float most_sigmas) {
  return block.width == kLanes && block.height == kLanes ? HasJump8(block, most_sigmas)
                                                         : HasJumpAny(block, most_sigmas);
}

}  // namespace slam
