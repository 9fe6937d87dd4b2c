#include "slam/extract/block_clusters.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <queue>

#include "slam/base/require.h"

namespace slam {
namespace {

struct Region {
  PlaneSums sums;
  PlaneFit fit;
  double grazing = 1.0;
  int version = 0;  ///< counts its merges, so that stale candidates are known
  int blocks = 0;   ///< 0: not a valid block
};

/// A possible merge of two neighbouring blocks' regions, as it was when it was evaluated.
struct Candidate {
  double cost;               ///< error added, or mean error
  int i, j;                  ///< blocks
  int version_i, version_j;  ///< of their regions
  /// Reversed, for a queue with the least on top.
  bool operator<(const Candidate& o) const {
    if (cost != o.cost) return cost > o.cost;
    return i != o.i ? i > o.i : j > o.j;
  }
};

class Clustering {
 public:
  Clustering(const DepthNoise& noise, const ClusterConfig& config)
      : noise_(noise), config_(config) {}

  void SumBlocks(const DepthGrid& grid, const std::vector<std::uint8_t>& taken, int block_px) {
    cols_ = (grid.width + block_px - 1) / block_px,
    rows_ = (grid.height + block_px - 1) / block_px;
    regions_.resize(static_cast<std::size_t>(cols_ * rows_));
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < cols_; ++c) SumBlock(grid, taken, block_px, r, c);
    }
    parent_.resize(regions_.size());
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  void Merge() {
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < cols_; ++c) {
        const int i = r * cols_ + c;
        if (c + 1 < cols_) Propose(i, i + 1);
        if (r + 1 < rows_) Propose(i, i + cols_);
      }
    }
    while (!queue_.empty()) {
      const Candidate top = queue_.top();
      queue_.pop();
      const int a = Root(top.i), b = Root(top.j);
      if (a == b) continue;
      if (At(a).version != top.version_i || At(b).version != top.version_j) {
        Propose(top.i, top.j);
      } else {
        Join(a, b);
      }
    }
  }

  BlockClusters Result(int block_px) {
    BlockClusters out{block_px, cols_, rows_, std::vector<int>(regions_.size(), -1), {}, {}};
    std::vector<int> number(regions_.size(), -1);
    for (int i = 0; i < cols_ * rows_; ++i) {
      const int root = Root(i);
      if (At(root).blocks < std::max(config_.min_blocks, 1)) continue;
      int& id = number[static_cast<std::size_t>(root)];
      if (id < 0) {
        id = static_cast<int>(out.sums.size());
        out.sums.push_back(At(root).sums);
        out.planes.push_back(At(root).fit.plane);
      }
      out.region[static_cast<std::size_t>(i)] = id;
    }
    return out;
  }

 private:
  Region& At(int i) { return regions_[static_cast<std::size_t>(i)]; }

  void SumBlock(const DepthGrid& grid, const std::vector<std::uint8_t>& taken, int block_px,
                int r, int c) {
    const int v1 = std::min((r + 1) * block_px, grid.height);
    const int u1 = std::min((c + 1) * block_px, grid.width);
    PlaneSums sums;
    for (int v = r * block_px; v < v1; ++v) {
      for (int u = c * block_px; u < u1; ++u) {
        const auto i = static_cast<std::size_t>(grid.Index(u, v));
        const double g = static_cast<double>(grid.g[i]);
        if (g > 0 && (taken.empty() || taken[i] == 0)) {
          sums.Add(static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]),
                   static_cast<double>(grid.q[i]), g * g);
        }
      }
    }
    if (!(sums.n >= config_.min_measured * block_px * block_px)) return;
    const std::optional<PlaneFit> fit = Fit(sums);
    if (!fit) return;
    if (HasJump(grid, c * block_px, r * block_px, u1, v1)) return;
    const double grazing = GrazingFactor(sums, fit->plane, noise_);
    if (!(fit->error < config_.max_block_error * grazing * grazing * sums.n)) return;
    At(r * cols_ + c) = {sums, *fit, grazing, 0, 1};
  }

  bool HasJump(const DepthGrid& grid, int u0, int v0, int u1, int v1) const {
    const float most = static_cast<float>(config_.max_jump_sigmas);
    const auto jump = [&](std::size_t i, std::size_t j) {
      return grid.g[i] > 0 && grid.g[j] > 0 &&
             std::abs(grid.q[i] - grid.q[j]) * grid.g[i] > most;
    };
    for (int v = v0; v < v1; ++v) {
      for (int u = u0; u < u1; ++u) {
        const auto i = static_cast<std::size_t>(grid.Index(u, v));
        if (u + 1 < u1 && jump(i, i + 1)) return true;
        if (v + 1 < v1 && jump(i, i + static_cast<std::size_t>(grid.width))) return true;
      }
    }
    return false;
  }

  int Root(int i) {
    int root = i;
    while (parent_[static_cast<std::size_t>(root)] != root) {
      root = parent_[static_cast<std::size_t>(root)];
    }
    while (parent_[static_cast<std::size_t>(i)] != root) {
      const int next = parent_[static_cast<std::size_t>(i)];
      parent_[static_cast<std::size_t>(i)] = root;
      i = next;
    }
    return root;
  }

  /// Queues the merge of two blocks' regions if noise explains what it adds.
  void Propose(int i, int j) {
    const Region& a = At(Root(i));
    const Region& b = At(Root(j));
    if (a.blocks == 0 || b.blocks == 0) return;
    PlaneSums both = a.sums;
    both += b.sums;
    const std::optional<PlaneFit> fit = Fit(both);
    if (!fit) return;
    const double grazing = std::max(a.grazing, b.grazing);
    const bool by_mean = config_.merge_rule == MergeRule::kMeanError;
    const double cost = by_mean ? fit->error / both.n : fit->error - a.fit.error - b.fit.error;
    const double k = config_.model_error_sigmas;
    const double bound = by_mean ? config_.max_block_error
                                 : config_.max_merge_chi2 * noise_.correlated_px +
                                       k * k * a.sums.n * b.sums.n / both.n;
    if (!(cost < grazing * grazing * bound)) return;
    queue_.push({cost, i, j, a.version, b.version});
  }

  void Join(int a, int b) {
    if (At(a).blocks < At(b).blocks || (At(a).blocks == At(b).blocks && b < a)) std::swap(a, b);
    Region& into = At(a);
    into.sums += At(b).sums;
    into.fit = Fit(into.sums).value_or(into.fit);
    into.grazing = GrazingFactor(into.sums, into.fit.plane, noise_);
    into.blocks += At(b).blocks;
    ++into.version;
    parent_[static_cast<std::size_t>(b)] = a;
  }

  const DepthNoise& noise_;
  const ClusterConfig& config_;
  int cols_ = 0, rows_ = 0;
  std::vector<Region> regions_;
  std::vector<int> parent_;
  std::priority_queue<Candidate> queue_;
};

}  // namespace

BlockClusters ClusterBlocks(const DepthGrid& grid, const std::vector<std::uint8_t>& taken,
                            int block_px, const DepthNoise& noise,
                            const ClusterConfig& config) {
  Require(block_px > 1, "ClusterBlocks: a block has at least 2 x 2 pixels");
  Require(taken.empty() || taken.size() == grid.q.size(),
          "ClusterBlocks: mask differs in size");
  Clustering clustering(noise, config);
  clustering.SumBlocks(grid, taken, block_px);
  clustering.Merge();
  return clustering.Result(block_px);
}

}  // namespace slam
