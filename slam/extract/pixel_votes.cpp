#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "slam/extract/pixel_growth.h"

namespace slam {
namespace {

// A plane that fewer pixels of a block may belong to is no rival there.
constexpr int kLeastPixels = 4;

}  // namespace

/// costs[pixel of the block]: squared distances of the pixels around it from the plane, each
/// cut off where a pixel no longer belongs.
void PixelGrowth::SumCosts(int block, const LabelPlane& plane, float* costs) {
  const int size = Stride(), reach = config_.vote_reach_px;
  const int u0 = layout_.Left(block), u1 = layout_.Right(block);
  const int v0 = layout_.Top(block), v1 = layout_.Bottom(block);
  const int left = u0 - reach, width = u1 + reach - left;  // columns, some beyond the image
  const int from = std::max(left, 0), to = std::min(u1 + reach, layout_.width);
  const int top = std::max(v0 - reach, 0), bottom = std::min(v1 + reach, layout_.height);
  const auto most = static_cast<float>(config_.max_pixel_sigmas * config_.max_pixel_sigmas);
  const PlaneResidual residual(plane);
  line_.assign(static_cast<std::size_t>(width + kLanes), 0.0f);
  rows_.resize(static_cast<std::size_t>(size * (bottom - top)));
  for (int v = top; v < bottom; ++v) {
    const auto i = static_cast<std::size_t>(grid_->Index(from, v));
    const float *x = &grid_->x[i], *y = &grid_->y[i], *q = &grid_->q[i], *g = &grid_->g[i];
    float* line = line_.data() + (from - left);
    int k = 0;
    for (; k + kLanes <= to - from; k += kLanes) {
      const Floats r = residual(Load(x + k), Load(y + k), Load(q + k), Load(g + k));
      Store(Least(r * r, All(most)), line + k);
    }
    for (; k < to - from; ++k) {
      const float r = residual(x[k], y[k], q[k], g[k]);
      line[k] = std::min(r * r, most);
    }
    float* row = rows_.data() + (v - top) * size;
    // Rows are kept in whole lanes; what lies beyond the block's end is never looked at.
    for (int at = 0; at < u1 - u0; at += kLanes) {
      Floats sum = Load(line_.data() + at);
      for (int d = 1; d <= 2 * reach; ++d) sum += Load(line_.data() + at + d);
      Store(sum, row + at);
    }
  }
  std::fill_n(costs, size * layout_.block_px, 0.0f);
  for (int v = v0; v < v1; ++v) {
    float* cost = costs + (v - v0) * size;
    for (int y = std::max(v - reach, top); y < std::min(v + reach + 1, bottom); ++y) {
      const float* row = rows_.data() + (y - top) * size;
      for (int at = 0; at < u1 - u0; at += kLanes)
        Store(Load(cost + at) + Load(row + at), cost + at);
    }
  }
}

/// Gives each pixel of a block, among the planes that may have it, to the one that fits the
/// pixels around it best.
void PixelGrowth::Vote(int block) {
  const Block& b = blocks_[static_cast<std::size_t>(block)];
  std::array<int, kMostCandidates> rivals{};
  int count = 0;
  for (int k = 0; k < b.count; ++k) {
    if (b.near[static_cast<std::size_t>(k)] >= kLeastPixels) {
      rivals[static_cast<std::size_t>(count++)] = b.label[static_cast<std::size_t>(k)];
    }
  }
  if (count < 2) return;
  std::sort(rivals.begin(), rivals.begin() + count);
  const int size = Stride(), area = size * layout_.block_px;
  costs_.resize(static_cast<std::size_t>(2 * area));
  float* least = costs_.data();
  float* cost = least + area;
  std::fill_n(least, area, std::numeric_limits<float>::infinity());
  const int u0 = layout_.Left(block), n = layout_.Right(block) - u0, v0 = layout_.Top(block);
  const auto farthest = static_cast<float>(config_.max_pixel_sigmas);
  for (int r = 0; r < count; ++r) {
    const int label = rivals[static_cast<std::size_t>(r)];
    const LabelPlane& plane = planes_[static_cast<std::size_t>(label)];
    const PlaneResidual residual(plane);
    SumCosts(block, plane, cost);
    for (int v = v0; v < layout_.Bottom(block); ++v) {
      const auto i = static_cast<std::size_t>(grid_->Index(u0, v));
      const float *x = &grid_->x[i], *y = &grid_->y[i], *q = &grid_->q[i], *g = &grid_->g[i];
      std::int32_t* labels = &labels_[i];
      float* best = least + (v - v0) * size;
      const float* own = cost + (v - v0) * size;
      int k = 0;
      for (; k + kLanes <= n; k += kLanes) {
        const Floats weight = Load(g + k), before = Load(best + k), now = Load(own + k);
        const Floats d = Magnitude(residual(Load(x + k), Load(y + k), Load(q + k), weight));
        const Ints better = (weight > All(0.0f)) & (d < All(farthest)) & (now < before);
        Store(better ? All(label) : Load(labels + k), labels + k);
        Store(better ? now : before, best + k);
      }
      for (; k < n; ++k) {
        const float d = std::abs(residual(x[k], y[k], q[k], g[k]));
        const bool better = g[k] > 0.0f && d < farthest && own[k] < best[k];
        labels[k] = better ? label : labels[k];
        best[k] = better ? own[k] : best[k];
      }
    }
  }
}

void PixelGrowth::Settle() {
  for (int block = 0; block < layout_.Count(); ++block) {
    Block& b = blocks_[static_cast<std::size_t>(block)];
    if (!b.changed) continue;
    b.changed = false;
    Vote(block);
  }
}

/// What each label gains over the next best plane at the pixels of a block, and how that would
/// change if that plane were not there.
void PixelGrowth::AddGains(int block) {
  const Block& b = blocks_[static_cast<std::size_t>(block)];
  const auto unexplained = static_cast<float>(config_.max_pixel_sigmas + 1.0);
  const double alone = static_cast<double>(unexplained * unexplained) - 1.0;
  std::array<int, kMostCandidates> rivals{};
  int count = 0;
  for (int k = 0; k < b.count; ++k) {
    if (b.near[static_cast<std::size_t>(k)] >= kLeastPixels) {
      rivals[static_cast<std::size_t>(count++)] = k;
    }
  }
  if (count == 0) return;
  if (count == 1) {
    const auto at = static_cast<std::size_t>(rivals[0]);
    gain_[static_cast<std::size_t>(b.label[at])] += alone * b.near[at];
    pixels_[static_cast<std::size_t>(b.label[at])] += b.near[at];
    return;
  }
  const int size = Stride(), area = size * layout_.block_px;
  costs_.resize(static_cast<std::size_t>(kMostCandidates * area));
  const int u0 = layout_.Left(block), v0 = layout_.Top(block), n = layout_.Right(block) - u0;
  for (int r = 0; r < count; ++r) {
    const auto label = b.label[static_cast<std::size_t>(rivals[static_cast<std::size_t>(r)])];
    const PlaneResidual residual(planes_[static_cast<std::size_t>(label)]);
    for (int v = v0; v < layout_.Bottom(block); ++v) {
      const auto i = static_cast<std::size_t>(grid_->Index(u0, v));
      float* to = costs_.data() + r * area + (v - v0) * size;
      for (int k = 0; k < n; ++k) {
        const float d = residual(*grid_, i + static_cast<std::size_t>(k));
        to[k] = d * d;
      }
    }
  }
  for (int v = v0; v < layout_.Bottom(block); ++v) {
    for (int k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(grid_->Index(u0 + k, v));
      if (labels_[i] == kNoLabel) continue;
      float next = unexplained * unexplained, own = 0.0f;
      int next_label = -1;
      for (int r = 0; r < count; ++r) {
        const int other =
            b.label[static_cast<std::size_t>(rivals[static_cast<std::size_t>(r)])];
        const float d2 = costs_[static_cast<std::size_t>(r * area + (v - v0) * size + k)];
        if (other == labels_[i]) {
          own = d2;
        } else if (d2 < next) {
          next = d2, next_label = other;
        }
      }
      const auto label = static_cast<std::size_t>(labels_[i]);
      ++pixels_[label];
      gain_[label] += static_cast<double>(next - own);
      if (next_label >= 0) {
        without_[label * planes_.size() + static_cast<std::size_t>(next_label)] +=
            static_cast<double>(unexplained * unexplained - next);
      }
    }
  }
}

/// Takes planes away from a block.
void PixelGrowth::TakeOut(int block, const std::vector<bool>& dropped) {
  Block& b = blocks_[static_cast<std::size_t>(block)];
  int count = 0;
  bool lost = false;
  for (int k = 0; k < b.count; ++k) {
    const auto from = static_cast<std::size_t>(k), to = static_cast<std::size_t>(count);
    if (dropped[static_cast<std::size_t>(b.label[from])]) {
      lost = lost || b.near[from] > 0;
      continue;
    }
    b.label[to] = b.label[from], b.near[to] = b.near[from];
    ++count;
  }
  b.count = count;
  if (!lost) return;
  Reclaim(block);
  // A plane may go on where another one was in its way.
  for (int k = 0; k < count; ++k) {
    pending_.emplace_back(block, b.label[static_cast<std::size_t>(k)]);
  }
}

void PixelGrowth::DropUseless() {
  const std::size_t count = planes_.size();
  gain_.assign(count, 0.0), pixels_.assign(count, 0), without_.assign(count * count, 0.0);
  for (int block = 0; block < layout_.Count(); ++block) {
    if (blocks_[static_cast<std::size_t>(block)].count > 0) AddGains(block);
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return pixels_[a] < pixels_[b]; });
  std::vector<bool> dropped(count, false);
  bool any = false;
  for (const std::size_t label : order) {
    if (gain_[label] >= config_.min_gain * std::max(pixels_[label], 1)) continue;
    dropped[label] = any = true;
    for (std::size_t other = 0; other < count; ++other) {
      gain_[other] += without_[other * count + label];
    }
  }
  if (!any) return;
  for (int block = 0; block < layout_.Count(); ++block) TakeOut(block, dropped);
  Grow();
  Settle();
}

}  // namespace slam
