#include "slam/segment/growth/block_assignment.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "slam/geometry/camera.h"
#include "tests/slam/segment/pixel_sets.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

TEST(BlockAssignment, GivesPixelsToTheLeastCostOfThePlanesNearAndTheFirstOfEqualOnes) {
  std::mt19937 random(5);
  for (int turn = 0; turn < 50; ++turn) {
    constexpr std::size_t kPlanes = 4;
    std::vector<PixelSet> near(kPlanes);
    std::vector<std::vector<float>> costs(
        kPlanes, std::vector<float>(kBlockPixels, std::numeric_limits<float>::infinity()));
    std::vector<CompetingPlane> planes;
    for (std::size_t r = 0; r < kPlanes; ++r) {
      for (int k = 0; k < kBlockPixels; ++k) {
        if (random() % 3 == 0) continue;
        near[r] |= PixelOf(k % kBlock_px, k / kBlock_px);
        costs[r][static_cast<std::size_t>(k)] = static_cast<float>(random() % 4);
      }
      planes.push_back({costs[r].data(), ~PixelSet{0}});  // of what was there before
    }
    AssignPixels(planes.data(), static_cast<int>(kPlanes));
    for (int k = 0; k < kBlockPixels; ++k) {
      const int u = k % kBlock_px, v = k / kBlock_px;
      std::size_t best = kPlanes;
      for (std::size_t r = 0; r < kPlanes; ++r) {
        if (!IsInSet(near[r], u, v)) continue;
        const auto at = static_cast<std::size_t>(k);
        if (best == kPlanes || costs[r][at] < costs[best][at]) best = r;
      }
      for (std::size_t r = 0; r < kPlanes; ++r)
        EXPECT_EQ(IsInSet(planes[r].owned, u, v), r == best);
    }
  }
}

TEST(BlockAssignment, IsDrawnWithNobodysPixelsWithinTheImageAlone) {
  Camera camera;
  camera.width = 21, camera.height = 19;
  const DepthGrid grid =
      MakeDepthGrid(cv::Mat1f(19, 21, 1.0f), PixelRays(camera), DepthNoise{}, 10.0);
  const ImageBlocks blocks = MakeBlocks(grid);
  LabelImage labels(grid.q.size(), 99), expected = labels;
  for (int k = 0; k < blocks.count(); ++k) {
    const BlockPixels& block = blocks.PixelsOf(k);
    const int u0 = k % blocks.cols * kBlock_px, v0 = k / blocks.cols * kBlock_px;
    PixelSet sets[2] = {0, 0};
    for (int v = 0; v < block.height; ++v) {
      for (int u = 0; u < block.width; ++u) {
        const auto i = static_cast<std::size_t>(grid.Index(u0 + u, v0 + v));
        const int who = v0 == 0 ? 0 : (u * 3 + v) % 4;  // one block has a single owner
        expected[i] = static_cast<std::int16_t>(who == 0 ? 300 : who == 1 ? 7 : kNoLabel);
        if (who < 2) sets[who] |= PixelOf(u, v);
      }
    }
    const BlockOwner owners[2] = {{300, sets[0]}, {7, sets[1]}};
    DrawOwners(block, owners, 2, labels.data() + grid.Index(u0, v0), grid.width);
  }
  EXPECT_EQ(labels, expected);
}

}  // namespace
}  // namespace slam
