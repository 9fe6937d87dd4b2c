#include "slam/extract/block_clusters.h"

#include <gtest/gtest.h>

#include <set>

#include "slam/base/camera.h"
#include "tests/support/closed_form_depth.h"

namespace slam {
namespace {

/// Regions of a wall at 1 m whose right part, from column `edge_px` on, is nearer by a step.
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
  return BlockClustering().Cluster(grid, {}, 8, noise, config);
}

/// The regions left and right of the step.
bool IsOneRegion(const BlockClusters& clusters) {
  return std::set<int>(clusters.region.begin(), clusters.region.end()).size() == 1;
}

// 12 mm at 1 m are 6.4 sigmas. A plane through both sides of a step in the middle leaves a
// quarter of its variance, 0.25 x 0.25 x 41 = 2.5 on top of 1 for noise, more than 3; of a step
// at 16 of 640 columns it leaves 0.025 x 41 = 1.
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

// A step that noise explains once it may be wider than the sensor's warp.
TEST(BlockClusters, ThatMergeAgainAreThoseOfTheOtherBounds) {
  const Camera camera;
  cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  depth_m(cv::Rect(320, 0, 320, camera.height)) -= 0.006f;
  depth_m(cv::Rect(100, 100, 50, 30)) = 0.0f;
  const DepthNoise noise;
  const DepthGrid grid =
      MakeDepthGrid(closed_form::AddKinectNoise(depth_m, 1), PixelRays(camera), noise, 10.0);
  ClusterConfig strict, wide;
  strict.model_error_sigmas = 0.5, wide.model_error_sigmas = 4.0;
  BlockClustering clustering, other;
  const std::size_t before = clustering.Cluster(grid, {}, 8, noise, strict).sums.size();
  const BlockClusters& again = clustering.MergeAgain(wide);
  const BlockClusters& expected = other.Cluster(grid, {}, 8, noise, wide);
  EXPECT_LT(expected.sums.size(), before);
  EXPECT_EQ(again.region, expected.region);
  ASSERT_EQ(again.sums.size(), expected.sums.size());
  for (std::size_t k = 0; k < expected.sums.size(); ++k)
    EXPECT_EQ(again.sums[k].wqq, expected.sums[k].wqq);
}

}  // namespace
}  // namespace slam
