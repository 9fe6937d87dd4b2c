#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "slam/base/index.h"
#include "slam/geometry/plane_sums.h"
#include "slam/segment/clusters/cluster_config.h"
#include "slam/segment/clusters/min_tree.h"
#include "slam/segment/pixels/image_blocks.h"

namespace slam {

/// The blocks of an image grouped into planes.
struct BlockClusters {
  int block_px = 0, cols = 0, rows = 0;
  std::vector<int> region;      ///< one a block, row-major; -1 = none
  std::vector<PlaneSums> sums;  ///< one a region
  std::vector<InverseDepthPlane> planes;
  std::vector<PlaneSums> block_sums;  ///< sums of the pixels of each block
};

/// Agglomerative clustering of blocks into planes (PEAC's method: Feng, Taguchi, Kamat, ICRA
/// 2014), on the graph of 4-neighbours.
///
/// Two changes keep thin steps apart. The pair merged next is the one whose merge adds least
/// error, and it merges only when that addition is what noise explains:
///
///   E(A u B) - E(A) - E(B)  <  s^2 (max_merge_chi2 correlated_px + k^2 n_A n_B / (n_A + n_B))
///
/// with E the error sum in sigmas, k = model_error_sigmas and s the grazing factor. (PEAC
/// bounds the mean error of the union, in which a block of a book vanishes among those of a
/// desk; `merge_rule` brings that back, with max_block_error as its bound.) Ties are broken by
/// block number. The memory of one image serves the next.
class BlockClustering {
 public:
  /// @param free  the pixels of each of the image's blocks that are clustered, all of them
  ///              measured
  /// @param block_px  kBlock_px, or kQuarter_px: what is clustered are the quarters of blocks
  BlockClusters Cluster(const ImageBlocks& blocks, const std::vector<PixelSet>& free,
                        int block_px, const DepthNoise& noise, const ClusterConfig& config);

 private:
  struct Region {
    PlaneSums sums;
    PlaneFit fit;
    double grazing = 1.0;
    int version = 0;  ///< another after each merge, of no other region
    int blocks = 1;
    int block = 0;  ///< its first
  };

  /// Two neighbouring blocks whose regions may be merged.
  struct Pair {
    int i, j;                  ///< regions of one block, or what they are part of
    int version_i, version_j;  ///< those of what they are part of, when last evaluated
  };

  Region& At(int i) { return regions_[Index(i)]; }
  void AddBlocks(const ImageBlocks& blocks, const std::vector<PixelSet>& free,
                 BlockClusters& out);
  void AddBlock(const BlockPixels& pixels, PixelSet free, PixelSet own, int block,
                BlockClusters& out);
  void Merge();
  int Root(int i);
  double Renew(Pair& pair);
  double Evaluate(const Region& a, const Region& b) const;
  void ProposeFirst();
  void Join(int a, int b);
  void Number(BlockClusters& out);

  const DepthNoise* noise_ = nullptr;
  const ClusterConfig* config_ = nullptr;
  int cols_ = 0, rows_ = 0;
  std::vector<Region> regions_;  ///< first the blocks that are planar, in their order
  std::vector<int> region_at_;   ///< one a block; -1 = none
  std::vector<int> parent_;      ///< one a region; its own number: it is part of no other
  std::vector<Pair> pairs_;      ///< in order of i, then j
  MinTree merges_;               ///< what each pair costs: error added or mean error
  int next_version_ = 0;
};

}  // namespace slam
