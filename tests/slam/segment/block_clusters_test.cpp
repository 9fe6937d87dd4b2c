#include "slam/segment/clusters/block_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "slam/geometry/camera.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// Regions of a wall at 1 m whose right part, from column `edge_px` on, is
/// nearer by a step.
BlockClusters StepClusters(double step_m, int edge_px, MergeRule rule, double max_block_error) {
  const Camera camera;
  cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  depth_m(cv::Rect(edge_px, 0, camera.width - edge_px, camera.height)) -=
      static_cast<float>(step_m);
  const DepthNoise noise;
  const DepthGrid grid =
      MakeDepthGrid(closed_form::AddKinectNoise(depth_m, 1), PixelRays(camera), noise, 10.0);
  ClusterConfig config;
  config.merge_rule = rule;
  config.max_block_error = max_block_error;
  const ImageBlocks blocks = MakeBlocks(grid);
  return BlockClustering().Cluster(blocks, blocks.measured, kBlock_px, noise, config);
}

/// The regions left and right of the step.
bool IsOneRegion(const BlockClusters& clusters) {
  return std::set<int>(clusters.region.begin(), clusters.region.end()).size() == 1;
}

// 12 mm at 1 m are 6.4 sigmas. A plane through both sides of a step in the
// middle leaves a quarter of its variance, 0.25 x 0.25 x 41 = 2.5 on top of 1
// for noise, more than 3; of a step at 16 of 640 columns it leaves 0.025 x 41
// = 1.
TEST(BlockClusters, ByAddedErrorKeepANarrowStepApart) {
  EXPECT_FALSE(IsOneRegion(StepClusters(0.012, 624, MergeRule::kAddedError, 3.0)));
}

TEST(BlockClusters, ByMeanErrorLoseANarrowStepInALargePlane) {
  EXPECT_TRUE(IsOneRegion(StepClusters(0.012, 624, MergeRule::kMeanError, 3.0)));
}

TEST(BlockClusters, ByMeanErrorKeepAWideStepApart) {
  EXPECT_FALSE(IsOneRegion(StepClusters(0.012, 320, MergeRule::kMeanError, 3.0)));
}

TEST(BlockClusters, ByMeanErrorAreBoundedByTheBlockError) {
  EXPECT_TRUE(IsOneRegion(StepClusters(0.012, 320, MergeRule::kMeanError, 8.0)));
  EXPECT_TRUE(IsOneRegion(StepClusters(0.0, 320, MergeRule::kMeanError, 3.0)));
}

/// The regions of blocks merged in the same order, with every pair kept and
/// evaluated itself.
class PlainMerge {
 public:
  PlainMerge(const BlockClusters& blocks, const std::vector<PlaneSums>& sums,
             const DepthNoise& noise, const ClusterConfig& config)
      : noise_(noise), config_(config), sums_(sums) {
    const int count = static_cast<int>(sums.size());
    for (int k = 0; k < count; ++k) {
      root_.push_back(k), changes_.push_back(0), size_.push_back(1);
      if (blocks.region[At(k)] < 0) continue;
      for (const int other : {(k + 1) % blocks.cols > 0 ? k + 1 : count, k + blocks.cols})
        if (other < count && blocks.region[At(other)] >= 0) pairs_.push_back({k, other});
    }
    for (Pair& pair : pairs_) Evaluate(pair);
  }

  std::vector<int> Regions() {
    while (true) {
      const auto next =
          std::min_element(pairs_.begin(), pairs_.end(),
                           [](const Pair& a, const Pair& b) { return a.cost < b.cost; });
      if (next->cost == kOut) return root_;
      int a = root_[At(next->i)], b = root_[At(next->j)];
      if (a == b) {
        next->cost = kOut;
      } else if (next->changes != changes_[At(a)] + changes_[At(b)]) {
        Evaluate(*next);
      } else {
        if (size_[At(a)] < size_[At(b)] || (size_[At(a)] == size_[At(b)] && b < a))
          std::swap(a, b);
        sums_[At(a)] += sums_[At(b)], size_[At(a)] += size_[At(b)];
        changes_[At(a)] += changes_[At(b)] + 1;
        std::replace(root_.begin(), root_.end(), b, a);
      }
    }
  }

 private:
  static constexpr double kOut = std::numeric_limits<double>::infinity();
  struct Pair {
    int i, j, changes = 0;  ///< of both regions together: they only grow
    double cost = kOut;
  };

  static std::size_t At(int k) { return static_cast<std::size_t>(k); }
  void Evaluate(Pair& pair) const {
    const std::size_t i = At(root_[At(pair.i)]), j = At(root_[At(pair.j)]);
    PlaneSums both = sums_[i];
    both += sums_[j];
    const PlaneFit a = *Fit(sums_[i]), b = *Fit(sums_[j]);
    const double grazing = std::max(GrazingFactor(sums_[i], a.plane, noise_),
                                    GrazingFactor(sums_[j], b.plane, noise_));
    const double k = config_.model_error_sigmas;
    const double bound = config_.max_merge_chi2 * noise_.correlated_px +
                         k * k * sums_[i].n * sums_[j].n / both.n;
    const double cost = Fit(both)->error - a.error - b.error;
    pair.cost = cost < grazing * grazing * bound ? cost : kOut;
    pair.changes = changes_[i] + changes_[j];
  }

  DepthNoise noise_;
  ClusterConfig config_;
  std::vector<PlaneSums> sums_;
  std::vector<int> root_, changes_, size_;
  std::vector<Pair> pairs_;
};

TEST(BlockClusters, AreThoseOfEveryPairEvaluatedItself) {
  Camera camera;
  camera.width = 160, camera.height = 120;
  ClusterConfig config;
  config.min_blocks = 1;
  for (const int seed : {1, 2, 3, 4, 5, 6}) {
    // The last three are slanted by 45 degrees, where noise is twice that of a frontal wall.
    DepthNoise noise;
    const bool slanted = seed > 3;
    if (slanted) noise.grazing_m = 0.002;
    const int which = slanted ? seed - 3 : seed;
    cv::Mat1f depth_m(camera.height, camera.width);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {  // a bent wall with a box before it
        const double x = slanted ? (u - camera.cx) / camera.fx : 0.0;
        depth_m(v, u) =
            static_cast<float>(1.0 / (1.0 + x) + 3e-4 * std::max(0, u - 40 * which));
      }
    }
    depth_m(cv::Rect(50, 40, 56, 48)) -= 0.01f * static_cast<float>(which);
    const DepthGrid grid =
        MakeDepthGrid(closed_form::AddKinectNoise(depth_m, static_cast<std::uint64_t>(seed)),
                      PixelRays(camera), noise, 10.0);
    const ImageBlocks blocks = MakeBlocks(grid);
    const BlockClusters got =
        BlockClustering().Cluster(blocks, blocks.measured, kBlock_px, noise, config);
    const std::vector<int> expected = PlainMerge(got, got.block_sums, noise, config).Regions();
    std::map<int, int> number;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      if (got.region[k] < 0) continue;
      const int next = static_cast<int>(number.size());
      EXPECT_EQ(got.region[k], number.emplace(expected[k], next).first->second) << k;
    }
    if (slanted) continue;  // there the box may merge with the wall
    EXPECT_GT(number.size(), 1u);
    EXPECT_LT(number.size(), expected.size() / 4);
  }
}

}  // namespace
}  // namespace slam
