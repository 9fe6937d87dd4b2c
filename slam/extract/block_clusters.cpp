#include "slam/extract/block_clusters.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

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
  double added_error;
  int i, j;                  ///< blocks
  int version_i, version_j;  ///< of their regions
  /// Reversed, for a queue with the least on top.
  bool operator<(const Candidate& o) const {
    if (added_error != o.added_error) return added_error > o.added_error;
    return i != o.i ? i > o.i : j > o.j;
  }
};

}  // namespace

struct ClusterScratch::Memory {
  std::vector<Region> regions;
  std::vector<int> parent, number;
  std::vector<Candidate> queue;
};

ClusterScratch::ClusterScratch() : memory(std::make_unique<Memory>()) {}
ClusterScratch::~ClusterScratch() = default;
ClusterScratch::ClusterScratch(ClusterScratch&&) noexcept = default;
ClusterScratch& ClusterScratch::operator=(ClusterScratch&&) noexcept = default;

namespace {

class Clustering {
 public:
  Clustering(const DepthNoise& noise, const ClusterConfig& config,
             ClusterScratch::Memory& memory)
      : noise_(noise),
        config_(config),
        regions_(memory.regions),
        parent_(memory.parent),
        number_(memory.number),
        queue_(memory.queue) {}

  /// Takes the blocks that are planar by themselves.
  void Start(const DepthGrid& grid, const BlockLayout& layout,
             const std::vector<PlaneSums>& sums) {
    cols_ = layout.cols, rows_ = layout.rows;
    regions_.assign(sums.size(), Region{});
    parent_.resize(sums.size());
    std::iota(parent_.begin(), parent_.end(), 0);
    queue_.clear();
    const double least = config_.min_measured * layout.block_px * layout.block_px;
    for (int block = 0; block < layout.Count(); ++block) {
      const PlaneSums& of_block = sums[static_cast<std::size_t>(block)];
      if (!(of_block.n >= least)) continue;
      const std::optional<PlaneFit> fit = Fit(of_block);
      if (!fit) continue;
      const double grazing = GrazingFactor(of_block, fit->plane, noise_);
      if (!(fit->error < config_.max_block_error * grazing * grazing * of_block.n)) continue;
      if (LargestJump(grid, layout, block) > static_cast<float>(config_.max_jump_sigmas))
        continue;
      At(block) = {of_block, *fit, grazing, 0, 1};
    }
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
      std::pop_heap(queue_.begin(), queue_.end());
      const Candidate top = queue_.back();
      queue_.pop_back();
      const int a = Root(top.i), b = Root(top.j);
      if (a == b) continue;
      if (At(a).version != top.version_i || At(b).version != top.version_j) {
        Propose(top.i, top.j);
      } else {
        Join(a, b);
      }
    }
  }

  void Result(BlockClusters& out) {
    out.region.assign(regions_.size(), -1);
    out.sums.clear(), out.planes.clear();
    number_.assign(regions_.size(), -1);
    for (int i = 0; i < cols_ * rows_; ++i) {
      const int root = Root(i);
      if (At(root).blocks < std::max(config_.min_blocks, 1)) continue;
      int& id = number_[static_cast<std::size_t>(root)];
      if (id < 0) {
        id = static_cast<int>(out.sums.size());
        out.sums.push_back(At(root).sums);
        out.planes.push_back(At(root).fit.plane);
      }
      out.region[static_cast<std::size_t>(i)] = id;
    }
  }

 private:
  Region& At(int i) { return regions_[static_cast<std::size_t>(i)]; }

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
    const double added = fit->error - a.fit.error - b.fit.error;
    const double k = config_.model_error_sigmas;
    const double grazing = std::max(a.grazing, b.grazing);
    const double bound =
        grazing * grazing *
        (config_.max_merge_chi2 * noise_.correlated_px + k * k * a.sums.n * b.sums.n / both.n);
    if (!(added < bound)) return;
    queue_.push_back({added, i, j, a.version, b.version});
    std::push_heap(queue_.begin(), queue_.end());
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
  std::vector<Region>& regions_;
  std::vector<int>& parent_;
  std::vector<int>& number_;
  std::vector<Candidate>& queue_;  ///< a heap
};

}  // namespace

void ClusterBlocks(const DepthGrid& grid, const BlockLayout& layout,
                   const std::vector<PlaneSums>& sums, const DepthNoise& noise,
                   const ClusterConfig& config, ClusterScratch& scratch, BlockClusters& out) {
  Require(static_cast<int>(sums.size()) == layout.Count(),
          "ClusterBlocks: sums differ in number from the blocks");
  Clustering clustering(noise, config, *scratch.memory);
  clustering.Start(grid, layout, sums);
  clustering.Merge();
  clustering.Result(out);
}

}  // namespace slam
