#include "slam/extract/block_rivals.h"

#include <cstddef>
#include <cstdint>
#include <limits>

#include "slam/base/lane_math.h"
#include "slam/extract/label_runs.h"

namespace slam {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

using EightShorts = std::int16_t __attribute__((vector_size(16)));
using EightMarks = std::uint8_t __attribute__((vector_size(8), aligned(1), may_alias));
SLAM_INLINE EightMarks& Marks(std::uint8_t* p) { return *reinterpret_cast<EightMarks*>(p); }

/// Adds eight floats to four sums.
SLAM_INLINE void AddTo(DoubleLanes& sum, FloatLanes v) {
  sum += DoubleLanes{static_cast<double>(v[0]), static_cast<double>(v[1]),
                     static_cast<double>(v[2]), static_cast<double>(v[3])};
  sum += DoubleLanes{static_cast<double>(v[4]), static_cast<double>(v[5]),
                     static_cast<double>(v[6]), static_cast<double>(v[7])};
}

}  // namespace

SLAM_LANES void ClaimBlock(BlockRival* rivals, int rival_count, int count, float most_sigmas,
                           int* owners) {
  const IntLanes none = IntLanes{} + kNoLabel;
  for (int r = 0; r < rival_count; ++r) rivals[r].pixels = 0;
  if (rival_count == 1) {
    const IntLanes label = IntLanes{} + rivals[0].label;
    IntLanes owned{};
    for (int k = 0; k < count; k += kLanes) {
      const IntLanes near = Size(Lanes(rivals[0].residuals + k)) < AllLanes(most_sigmas);
      Lanes(owners + k) = near ? label : none;
      owned -= near;
    }
    rivals[0].pixels = SumOf(owned);
    return;
  }
  for (int k = 0; k < count; k += kLanes) {
    FloatLanes least = AllLanes(kNone);
    IntLanes owner = none;
    for (int r = 0; r < rival_count; ++r) {
      const FloatLanes bid = Lanes(rivals[r].bids + k);
      const IntLanes better = bid < least;
      least = better ? bid : least;
      owner = better ? IntLanes{} + rivals[r].label : owner;
    }
    Lanes(owners + k) = owner;
  }
  for (int r = 0; r < rival_count; ++r) {
    IntLanes owned{};
    for (int k = 0; k < count; k += kLanes) owned -= Lanes(owners + k) == rivals[r].label;
    rivals[r].pixels = SumOf(owned);
  }
}

SLAM_LANES void GainsOfBlock(BlockRival* rivals, int rival_count, int count, float unexplained,
                             const int* owners, float* gains, int* next_labels) {
  const FloatLanes zero{};
  for (int k = 0; k < count; k += kLanes) {
    const IntLanes owner = Lanes(owners + k);
    FloatLanes own = zero, next = AllLanes(unexplained);
    IntLanes next_label = IntLanes{} + kNoLabel;
    for (int r = 0; r < rival_count; ++r) {
      const FloatLanes size = Size(Lanes(rivals[r].residuals + k));
      const IntLanes owns = owner == rivals[r].label;
      const IntLanes nearer = ~owns & (size < next);
      own = owns ? size : own;
      next = nearer ? size : next;
      next_label = nearer ? IntLanes{} + rivals[r].label : next_label;
    }
    Lanes(gains + k) = owner >= 0 ? next * next - own * own : zero;
    Lanes(next_labels + k) = next_label;
  }
  for (int r = 0; r < rival_count; ++r) {
    DoubleLanes sum{};
    for (int k = 0; k < count; k += kLanes) {
      AddTo(sum, Lanes(owners + k) == rivals[r].label ? Lanes(gains + k) : zero);
    }
    rivals[r].gain = SumOf(sum);
  }
}

SLAM_LANES void MarkOwned(const BlockPixels& block, int label, const int* owners,
                          std::uint8_t* marks) {
  for (int v = 0; v < block.height; ++v) {
    const int* row = owners + v * block.size;
    std::uint8_t* to = marks + static_cast<std::ptrdiff_t>(v) * block.stride;
    if (block.width == kLanes) {
      const IntLanes owned = (Lanes(row) == label) & 1;
      const EightShorts narrowed = __builtin_convertvector(owned, EightShorts);
      Marks(to) |= __builtin_convertvector(narrowed, EightMarks);
    } else {
      for (int u = 0; u < block.width; ++u) to[u] |= row[u] == label ? 1 : 0;
    }
  }
}

SLAM_LANES double SumOwned(const float* residuals, int count, int label, const int* owners) {
  DoubleLanes sum{};
  for (int k = 0; k < count; k += kLanes)
    AddTo(sum, Lanes(owners + k) == label ? Lanes(residuals + k) : FloatLanes{});
  return SumOf(sum);
}

}  // namespace slam
