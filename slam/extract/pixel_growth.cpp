#include "slam/extract/pixel_growth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace slam {
namespace {

// A plane owning fewer pixels of a block than this does not spread from it: chance crossings of
// another surface with the plane's extension are thinner.
constexpr int kLeastPixelsToSpread = 4;

constexpr std::int32_t kMixed = -2;  // below every label

}  // namespace

void PixelGrowth::Start(const DepthGrid& grid, const BlockLayout& layout,
                        const std::vector<PlaneSums>& block_sums, const GrowthConfig& config) {
  grid_ = &grid, block_sums_ = &block_sums;
  layout_ = layout;
  config_ = config;
  planes_.clear();
  blocks_.assign(static_cast<std::size_t>(layout.Count()), Block{});
  pending_.clear();
  labels_.assign(grid.q.size(), kNoLabel);
  distance_.assign(grid.q.size(), static_cast<float>(config.max_pixel_sigmas));
}

int PixelGrowth::AddPlane(const LabelPlane& plane) {
  planes_.push_back(plane);
  return static_cast<int>(planes_.size()) - 1;
}

void PixelGrowth::Reach(int block, int label) {
  Block& b = blocks_[static_cast<std::size_t>(block)];
  for (int k = 0; k < b.count; ++k) {
    if (b.label[static_cast<std::size_t>(k)] == label) return;
  }
  if (b.count == kMostCandidates) return;
  b.label[static_cast<std::size_t>(b.count)] = static_cast<std::int16_t>(label);
  b.near[static_cast<std::size_t>(b.count++)] = 0;
  b.changed = true;
  pending_.emplace_back(block, label);
}

/// Gives the pixels of a block that are nearest to a plane to it. @returns how many may be its.
int PixelGrowth::Claim(int block, int label) {
  const int u0 = layout_.Left(block), v0 = layout_.Top(block);
  const int n = layout_.Right(block) - u0, v1 = layout_.Bottom(block);
  const PlaneResidual residual(planes_[static_cast<std::size_t>(label)]);
  const auto farthest = static_cast<float>(config_.max_pixel_sigmas);
  Ints near = All(0);
  for (int v = v0; v < v1; ++v) {
    const auto i = static_cast<std::size_t>(grid_->Index(u0, v));
    const float *x = &grid_->x[i], *y = &grid_->y[i], *q = &grid_->q[i], *g = &grid_->g[i];
    float* distance = &distance_[i];
    std::int32_t* labels = &labels_[i];
    int k = 0;
    for (; k + kLanes <= n; k += kLanes) {
      const Floats weight = Load(g + k), before = Load(distance + k);
      const Ints owner = Load(labels + k);
      const Floats r = Magnitude(residual(Load(x + k), Load(y + k), Load(q + k), weight));
      // An unmeasured pixel would seem to lie on every plane.
      const Floats d = weight > All(0.0f) ? r : All(farthest);
      // Of two planes at one distance the lower label wins, in any order of work.
      const Ints nearer = (d < before) | ((d == before) & (All(label) < owner));
      near -= d < All(farthest);
      Store(nearer ? All(label) : owner, labels + k);
      Store(nearer ? d : before, distance + k);
    }
    for (; k < n; ++k) {
      if (!(g[k] > 0.0f)) continue;
      const float d = std::abs(residual(x[k], y[k], q[k], g[k]));
      near[0] += d < farthest ? 1 : 0;
      if (!(d < distance[k] || (d == distance[k] && label < labels[k]))) continue;
      labels[k] = label, distance[k] = d;
    }
  }
  return Total(near);
}

int PixelGrowth::Owned(int block, int label) const {
  const int u0 = layout_.Left(block), n = layout_.Right(block) - u0;
  int owned = 0;
  for (int v = layout_.Top(block); v < layout_.Bottom(block); ++v) {
    const std::int32_t* labels = &labels_[static_cast<std::size_t>(grid_->Index(u0, v))];
    int k = 0;
    Ints equal = All(0);
    for (; k + kLanes <= n; k += kLanes) equal -= Load(labels + k) == All(label);
    for (; k < n; ++k) owned += labels[k] == label ? 1 : 0;
    owned += Total(equal);
  }
  return owned;
}

void PixelGrowth::Grow() {
  // Each round adds a label to a block, so there are finitely many.
  while (!pending_.empty()) {
    round_.swap(pending_);
    pending_.clear();
    for (const auto& [block, label] : round_) {
      Block& b = blocks_[static_cast<std::size_t>(block)];
      const int near = Claim(block, label);
      for (int k = 0; k < b.count; ++k) {
        if (b.label[static_cast<std::size_t>(k)] == label) {
          b.near[static_cast<std::size_t>(k)] = static_cast<std::int16_t>(near);
        }
      }
    }
    for (const auto& [block, label] : round_) {
      if (Owned(block, label) < kLeastPixelsToSpread) continue;
      const int c = block % layout_.cols, r = block / layout_.cols;
      for (int y = std::max(r - 1, 0); y <= std::min(r + 1, layout_.rows - 1); ++y) {
        for (int x = std::max(c - 1, 0); x <= std::min(c + 1, layout_.cols - 1); ++x) {
          Reach(y * layout_.cols + x, label);
        }
      }
    }
  }
}

/// Claims a block anew for all its planes.
void PixelGrowth::Reclaim(int block) {
  const int u0 = layout_.Left(block), n = layout_.Right(block) - u0;
  for (int v = layout_.Top(block); v < layout_.Bottom(block); ++v) {
    const int i = grid_->Index(u0, v);
    std::fill_n(labels_.begin() + i, n, kNoLabel);
    std::fill_n(distance_.begin() + i, n, static_cast<float>(config_.max_pixel_sigmas));
  }
  Block& b = blocks_[static_cast<std::size_t>(block)];
  for (int k = 0; k < b.count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    b.near[at] = static_cast<std::int16_t>(Claim(block, b.label[at]));
  }
  b.changed = true;
}

void PixelGrowth::Replace(const std::vector<LabelPlane>& planes, const std::vector<int>& into) {
  planes_ = planes;
  for (int block = 0; block < layout_.Count(); ++block) {
    Block& b = blocks_[static_cast<std::size_t>(block)];
    int count = 0;
    for (int k = 0; k < b.count; ++k) {
      const auto label = static_cast<std::int16_t>(
          into[static_cast<std::size_t>(b.label[static_cast<std::size_t>(k)])]);
      const auto end = b.label.begin() + count;
      if (b.near[static_cast<std::size_t>(k)] == 0) continue;
      if (std::find(b.label.begin(), end, label) != end) continue;
      b.label[static_cast<std::size_t>(count++)] = label;
    }
    b.count = count;
    Reclaim(block);
  }
}

/// All measured pixels of the block are of one label.
bool PixelGrowth::Whole(int block) const {
  const Block& b = blocks_[static_cast<std::size_t>(block)];
  const PlaneSums& sums = (*block_sums_)[static_cast<std::size_t>(block)];
  int alone = -1;
  for (int k = 0; k < b.count; ++k) {
    if (b.near[static_cast<std::size_t>(k)] == 0) continue;
    if (alone >= 0) return false;
    alone = k;
  }
  return alone >= 0 && b.near[static_cast<std::size_t>(alone)] == static_cast<int>(sums.n);
}

/// The label of all measured pixels of a block, or kMixed.
std::int32_t PixelGrowth::OnlyLabel(const LabelImage& labels, int block) const {
  std::int32_t least = std::numeric_limits<std::int32_t>::max(), most = kMixed;
  const int u0 = layout_.Left(block), n = layout_.Right(block) - u0;
  for (int v = layout_.Top(block); v < layout_.Bottom(block); ++v) {
    const auto i = static_cast<std::size_t>(grid_->Index(u0, v));
    const std::int32_t* label = &labels[i];
    const float* g = &grid_->g[i];
    for (int k = 0; k < n; ++k) {
      const bool measured = g[k] > 0.0f;
      least = measured ? std::min(least, label[k]) : least;
      most = measured ? std::max(most, label[k]) : most;
    }
  }
  return least == most ? most : kMixed;
}

void PixelGrowth::SumSegments(const LabelImage& labels, int count,
                              std::vector<PlaneSums>& sums) const {
  sums.assign(static_cast<std::size_t>(count), PlaneSums{});
  std::vector<std::int32_t> present;
  for (int block = 0; block < layout_.Count(); ++block) {
    if (blocks_[static_cast<std::size_t>(block)].count == 0) continue;
    const int u0 = layout_.Left(block), u1 = layout_.Right(block);
    const std::int32_t only = Whole(block) ? OnlyLabel(labels, block) : kMixed;
    if (only != kMixed) {
      if (only != kNoLabel) {
        sums[static_cast<std::size_t>(only)] += (*block_sums_)[static_cast<std::size_t>(block)];
      }
      continue;
    }
    present.clear();
    for (int v = layout_.Top(block); v < layout_.Bottom(block); ++v) {
      std::int32_t last = kNoLabel;
      for (int u = u0; u < u1; ++u) {
        const std::int32_t label = labels[static_cast<std::size_t>(grid_->Index(u, v))];
        if (label == last || label == kNoLabel) continue;
        last = label;
        if (std::find(present.begin(), present.end(), label) == present.end()) {
          present.push_back(label);
        }
      }
    }
    for (const std::int32_t label : present) {
      sums[static_cast<std::size_t>(label)] += SumLabel(*grid_, layout_, block, labels, label);
    }
  }
}

void PixelGrowth::MarkSettled(double model_sigmas, double bias_sigmas, double correlated_px,
                              std::vector<std::uint8_t>& settled) const {
  settled.assign(labels_.size(), 0);
  for (int block = 0; block < layout_.Count(); ++block) {
    const Block& b = blocks_[static_cast<std::size_t>(block)];
    const int u0 = layout_.Left(block), n = layout_.Right(block) - u0;
    const int v0 = layout_.Top(block), v1 = layout_.Bottom(block);
    for (int k = 0; k < b.count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (b.near[at] == 0) continue;
      const std::int32_t label = b.label[at];
      const PlaneResidual residual(planes_[static_cast<std::size_t>(label)]);
      Floats lanes = All(0.0f);
      Ints owned = All(0);
      for (int v = v0; v < v1; ++v) {
        const auto i = static_cast<std::size_t>(grid_->Index(u0, v));
        int x = 0;
        for (; x + kLanes <= n; x += kLanes) {
          const std::size_t j = i + static_cast<std::size_t>(x);
          const Ints own = Load(&labels_[j]) == All(label);
          const Floats r = residual(Load(&grid_->x[j]), Load(&grid_->y[j]), Load(&grid_->q[j]),
                                    Load(&grid_->g[j]));
          lanes += own ? r : All(0.0f);
          owned -= own;
        }
        for (; x < n; ++x) {
          const std::size_t j = i + static_cast<std::size_t>(x);
          if (labels_[j] != label) continue;
          lanes[0] += residual(*grid_, j);
          ++owned[0];
        }
      }
      const int count = Total(owned);
      const double bound =
          model_sigmas + bias_sigmas * std::sqrt(correlated_px / std::max(count, 1));
      if (!(std::abs(Total(lanes)) < bound * count)) continue;
      for (int v = v0; v < v1; ++v) {
        const auto i = static_cast<std::size_t>(grid_->Index(u0, v));
        for (int x = 0; x < n; ++x) {
          const bool own = labels_[i + static_cast<std::size_t>(x)] == label;
          settled[i + static_cast<std::size_t>(x)] |= own ? std::uint8_t{1} : std::uint8_t{0};
        }
      }
    }
  }
}

}  // namespace slam
