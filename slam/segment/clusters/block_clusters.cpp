#include "slam/segment/clusters/block_clusters.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>

#include "slam/base/index.h"
#include "slam/base/require.h"

namespace slam {

BlockClusters BlockClustering::Cluster(const ImageBlocks& blocks,
                                       const std::vector<PixelSet>& free, int block_px,
                                       const DepthNoise& noise, const ClusterConfig& config) {
  Require(block_px == kBlock_px || block_px == kQuarter_px,
          "BlockClustering: blocks are 8 x 8 pixels, or quarters of such");
  Require(free.size() == blocks.pixels.size(), "BlockClustering: a set for each block");
  noise_ = &noise, config_ = &config;
  BlockClusters out;
  out.block_px = block_px;
  AddBlocks(blocks, free, out);
  Merge();
  Number(out);
  return out;
}

void BlockClustering::AddBlocks(const ImageBlocks& blocks, const std::vector<PixelSet>& free,
                                BlockClusters& out) {
  const int split = kBlock_px / out.block_px;  // of a side
  cols_ = out.cols = split * blocks.cols, rows_ = out.rows = split * blocks.rows;
  const auto count = static_cast<std::size_t>(cols_ * rows_);
  regions_.clear(), region_at_.assign(count, -1), out.block_sums.resize(count);
  for (int r = 0; r < rows_; ++r) {
    for (int c = 0; c < cols_; ++c) {
      const auto whole = static_cast<std::size_t>(r / split * blocks.cols + c / split);
      const PixelSet own = split == 1
                               ? kWholeBlock
                               : QuarterAt(c % split * kQuarter_px, r % split * kQuarter_px);
      AddBlock(blocks.pixels[whole], free[whole], own, r * cols_ + c, out);
    }
  }
  parent_.resize(regions_.size());
  std::iota(parent_.begin(), parent_.end(), 0);
}

void BlockClustering::AddBlock(const BlockPixels& pixels, PixelSet free, PixelSet own,
                               int block, BlockClusters& out) {
  if ((free & own) == 0) return;
  const PlaneSums& sums = out.block_sums[Index(block)] = SumOfSet(pixels, free & own);

  // A block is planar if enough of it is measured, nothing in it jumps, and noise explains how
  // it scatters about its plane.
  if (!(sums.n >= config_->min_measured * std::popcount(own))) return;
  const std::optional<PlaneFit> fit = Fit(sums);
  if (!fit) return;
  if (HasJump(pixels, static_cast<float>(config_->max_jump_sigmas), own)) return;
  const double grazing = GrazingFactor(sums, fit->plane, *noise_);
  if (!(fit->error < config_->max_block_error * grazing * grazing * sums.n)) return;
  const int region = static_cast<int>(regions_.size());
  region_at_[Index(block)] = region;
  regions_.push_back({sums, *fit, grazing, region, 1, block});
}

void BlockClustering::ProposeFirst() {
  pairs_.clear();
  std::vector<double> costs;
  for (int k = 0; k < static_cast<int>(regions_.size()); ++k) {
    const int block = At(k).block;
    const auto beside = [&](int other) {
      const int j = region_at_[Index(other)];
      if (j < 0) return;
      pairs_.push_back({k, j, k, j});
      costs.push_back(Evaluate(At(k), At(j)));
    };
    if (block % cols_ + 1 < cols_) beside(block + 1);
    if (block / cols_ + 1 < rows_) beside(block + cols_);
  }
  merges_.Begin(costs);
}

void BlockClustering::Merge() {
  next_version_ = static_cast<int>(regions_.size());
  ProposeFirst();

  // The cheapest pair merges, unless one of its regions has grown since it was evaluated: then
  // it is put back with what it costs now.
  while (!merges_.empty()) {
    const int next = merges_.first();
    Pair& pair = pairs_[Index(next)];
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
    int& parent = parent_[Index(i)];
    if (parent == i) return i;
    i = parent = parent_[Index(parent)];
  }
}

/// What the merge of the regions of a pair costs now.
double BlockClustering::Renew(Pair& pair) {
  const Region &a = At(pair.i), &b = At(pair.j);
  pair.version_i = a.version, pair.version_j = b.version;
  return Evaluate(a, b);
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
  parent_[Index(b)] = a;
}

/// Numbers the regions that are large enough, in order of their first block.
void BlockClustering::Number(BlockClusters& out) {
  out.region.assign(region_at_.size(), -1);
  std::vector<int> number(regions_.size(), -1);
  for (int k = 0; k < static_cast<int>(regions_.size()); ++k) {
    const int root = Root(k);
    if (At(root).blocks < std::max(config_->min_blocks, 1)) continue;
    int& id = number[Index(root)];
    if (id < 0) {
      id = static_cast<int>(out.sums.size());
      out.sums.push_back(At(root).sums);
      out.planes.push_back(At(root).fit.plane);
    }
    out.region[Index(At(k).block)] = id;
  }
}

}  // namespace slam
