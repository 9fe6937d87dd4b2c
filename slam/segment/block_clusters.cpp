#include "slam/segment/block_clusters.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "slam/base/require.h"
#include "slam/segment/block_sums.h"

namespace slam {
namespace {

// Odd factors that spread versions over the table: 2^32 over the golden ratio (Knuth), and one
// of MurmurHash3 (Appleby).
constexpr std::uint32_t kSpreadI = 0x9e3779b1u, kSpreadJ = 0x85ebca6bu;
constexpr int kVersionBits = 32;

}  // namespace

const BlockClusters& BlockClustering::Cluster(const DepthGrid& grid,
                                              const std::vector<std::uint8_t>& taken,
                                              int block_px, const DepthNoise& noise,
                                              const ClusterConfig& config) {
  Require(block_px > 1, "BlockClustering: a block has at least 2 x 2 pixels");
  Require(taken.empty() || taken.size() == grid.q.size(),
          "BlockClustering: mask differs in size");
  noise_ = &noise, config_ = &config;
  AddBlocks(grid, taken, block_px);
  Merge();
  Number(block_px);
  return out_;
}

void BlockClustering::AddBlocks(const DepthGrid& grid, const std::vector<std::uint8_t>& taken,
                                int block_px) {
  cols_ = (grid.width + block_px - 1) / block_px;
  rows_ = (grid.height + block_px - 1) / block_px;
  regions_.clear();
  if (taken.empty()) sums_.clear();
  measured_.resize(WordsOfSet(block_px));
  region_at_.assign(static_cast<std::size_t>(cols_ * rows_), -1);
  const double min_pixels = config_->min_measured * block_px * block_px;

  // With a mask, most blocks have too few free pixels, which counting columns tells first.
  for (int r = 0; r < rows_; ++r) {
    const int v = r * block_px;
    const auto row = static_cast<std::size_t>(grid.Index(0, v));
    const std::uint8_t* mask = taken.empty() ? nullptr : taken.data() + row;
    if (mask != nullptr) {
      free_.resize(static_cast<std::size_t>(grid.width));
      CountFree(grid.g.data() + row, mask, grid.width, grid.width,
                std::min(block_px, grid.height - v), free_.data());
    }
    for (int c = 0; c < cols_; ++c) {
      const int u = c * block_px;
      if (mask == nullptr) {
        AddBlock(grid, nullptr, u, v, block_px, r * cols_ + c);
        continue;
      }
      const auto first = free_.begin() + u;
      const int free = std::accumulate(first, first + std::min(block_px, grid.width - u), 0);
      if (free >= min_pixels) AddBlock(grid, mask + u, u, v, block_px, r * cols_ + c);
    }
  }
  parent_.resize(regions_.size());
  std::iota(parent_.begin(), parent_.end(), 0);
}

void BlockClustering::AddBlock(const DepthGrid& grid, const std::uint8_t* taken, int u, int v,
                               int block_px, int block) {
  const BlockPixels pixels = BlockAt(grid, u, v, block_px);
  const double min_pixels = config_->min_measured * block_px * block_px;
  if (taken == nullptr) FindMeasured(pixels, measured_.data());
  const PlaneSums sums =
      taken == nullptr ? SumBlock(pixels, measured_.data()) : SumFree(pixels, taken);
  if (taken == nullptr) sums_.push_back(sums);

  // A block is planar if enough of it is measured, nothing in it jumps, and noise explains how
  // it scatters about its plane.
  if (!(sums.n >= min_pixels)) return;
  const std::optional<PlaneFit> fit = Fit(sums);
  if (!fit) return;
  if (HasJump(pixels, static_cast<float>(config_->max_jump_sigmas))) return;
  const double grazing = GrazingFactor(sums, fit->plane, *noise_);
  if (!(fit->error < config_->max_block_error * grazing * grazing * sums.n)) return;
  region_at_[static_cast<std::size_t>(block)] = static_cast<int>(regions_.size());
  AddRegion(sums, *fit, grazing, block);
}

void BlockClustering::AddRegion(const PlaneSums& sums, const PlaneFit& fit, double grazing,
                                int block) {
  regions_.push_back({sums, fit, grazing, static_cast<int>(regions_.size()), 1, block});
}

void BlockClustering::ProposeFirst() {
  pairs_.clear(), first_costs_.clear();
  for (int k = 0; k < static_cast<int>(regions_.size()); ++k) {
    const int block = At(k).block;
    const auto beside = [&](int other) {
      const int j = region_at_[static_cast<std::size_t>(other)];
      if (j < 0) return;
      pairs_.push_back({k, j, k, j});
      first_costs_.push_back(Evaluate(At(k), At(j)));
    };
    if (block % cols_ + 1 < cols_) beside(block + 1);
    if (block / cols_ + 1 < rows_) beside(block + cols_);
  }
  merges_.Begin(first_costs_);
}

void BlockClustering::Merge() {
  next_version_ = static_cast<int>(regions_.size());
  known_costs_.assign(std::size_t{1} << kKnownBits, {});
  ProposeFirst();

  // The cheapest pair merges, unless one of its regions has grown since it was evaluated: then
  // it is put back with what it costs now.
  while (merges_.min() < MinTree::kNone) {
    const int next = merges_.first();
    Pair& pair = pairs_[static_cast<std::size_t>(next)];
    pair.i = Root(pair.i), pair.j = Root(pair.j);
    if (pair.i == pair.j) {
      merges_.Change(next, MinTree::kNone);
      continue;
    }
    const bool known =
        At(pair.i).version == pair.version_i && At(pair.j).version == pair.version_j;
    if (known) Join(pair.i, pair.j);
    merges_.Change(next, known ? MinTree::kNone : Renew(pair));
  }
}

int BlockClustering::Root(int i) {
  while (true) {
    int& parent = parent_[static_cast<std::size_t>(i)];
    if (parent == i) return i;
    i = parent = parent_[static_cast<std::size_t>(parent)];
  }
}

/// What the merge of the regions of a pair costs now. Regions that have grown along each other
/// meet in many pairs, which ask for the same one after the other.
double BlockClustering::Renew(Pair& pair) {
  const Region &a = At(pair.i), &b = At(pair.j);
  pair.version_i = a.version, pair.version_j = b.version;
  const auto i = static_cast<std::uint32_t>(a.version);
  const auto j = static_cast<std::uint32_t>(b.version);
  KnownCost& known = known_costs_[(i * kSpreadI ^ j * kSpreadJ) >> (kVersionBits - kKnownBits)];
  if (known.version_i != a.version || known.version_j != b.version)
    known = {a.version, b.version, Evaluate(a, b)};
  return known.cost;
}

/// What a merge costs, if noise explains it. Flat: of the fit only the error is needed.
[[gnu::flatten]] double BlockClustering::Evaluate(const Region& a, const Region& b) const {
  PlaneSums both = a.sums;
  both += b.sums;
  const std::optional<PlaneFit> fit = Fit(both);
  if (!fit) return MinTree::kNone;
  const double grazing = std::max(a.grazing, b.grazing);
  const bool by_mean = config_->merge_rule == MergeRule::kMeanError;
  const double cost = by_mean ? fit->error / both.n : fit->error - a.fit.error - b.fit.error;
  const double k = config_->model_error_sigmas;
  const double bound = by_mean ? config_->max_block_error
                               : config_->max_merge_chi2 * noise_->correlated_px +
                                     k * k * a.sums.n * b.sums.n / both.n;
  return cost < grazing * grazing * bound ? cost : MinTree::kNone;
}

void BlockClustering::Join(int a, int b) {
  if (At(a).blocks < At(b).blocks || (At(a).blocks == At(b).blocks && b < a)) std::swap(a, b);
  Region& into = At(a);
  into.sums += At(b).sums;
  into.fit = Fit(into.sums).value_or(into.fit);
  into.grazing = GrazingFactor(into.sums, into.fit.plane, *noise_);
  into.blocks += At(b).blocks;
  into.version = next_version_++;
  parent_[static_cast<std::size_t>(b)] = a;
}

/// Numbers the regions that are large enough, in order of their first block.
void BlockClustering::Number(int block_px) {
  out_.block_px = block_px, out_.cols = cols_, out_.rows = rows_;
  out_.sums.clear(), out_.planes.clear();
  out_.region.assign(region_at_.size(), -1);
  number_.assign(regions_.size(), -1);
  for (int k = 0; k < static_cast<int>(regions_.size()); ++k) {
    const int root = Root(k);
    if (At(root).blocks < std::max(config_->min_blocks, 1)) continue;
    int& id = number_[static_cast<std::size_t>(root)];
    if (id < 0) {
      id = static_cast<int>(out_.sums.size());
      out_.sums.push_back(At(root).sums);
      out_.planes.push_back(At(root).fit.plane);
    }
    out_.region[static_cast<std::size_t>(At(k).block)] = id;
  }
}

}  // namespace slam
