#include "slam/extract/block_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "slam/base/camera.h"
#include "slam/extract/block_sums.h"

namespace slam {
namespace {

constexpr float kTooFar = std::numeric_limits<float>::infinity();

/// A noisy slope with holes, which planes fit here and there.
DepthGrid RoughGrid(int width, int height, double k1 = 0.0) {
  Camera camera;
  camera.k1 = k1;
  camera.width = width, camera.height = height;
  camera.cx = 0.5 * width, camera.cy = 0.5 * height;
  cv::Mat1f depth_m(height, width);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int noise = (u * 7919 + v * 104729) % 97;
      depth_m(v, u) = noise == 5 ? 0.0f
                                 : 1.0f + 0.002f * static_cast<float>(u) +
                                       0.0001f * static_cast<float>(noise - 48);
    }
  }
  return MakeDepthGrid(depth_m, PixelRays(camera), DepthNoise{}, 10.0);
}

const LabelPlane kPlane{{-0.9, 0.02, 0.97}, 1.3};

/// What a bid is by its definition.
float PlainBid(const DepthGrid& grid, int u, int v, int reach, float most) {
  const auto i = static_cast<std::size_t>(grid.Index(u, v));
  if (!(grid.g[i] > 0) || std::abs(ResidualSigmas(grid, i, kPlane)) >= most) return kTooFar;
  float bid = 0.0f;
  for (int y = v - reach; y <= v + reach; ++y) {
    float row = 0.0f;
    for (int x = u - reach; x <= u + reach; ++x) {
      if (x < 0 || y < 0 || x >= grid.width || y >= grid.height) continue;
      const float r = ResidualSigmas(grid, static_cast<std::size_t>(grid.Index(x, y)), kPlane);
      row += std::min(r * r, most * most);
    }
    bid += row;
  }
  return bid;
}

BidWindow WindowOf(const DepthGrid& grid, const BlockPixels& block, int u, int v, int reach) {
  return {reach,
          std::min(reach, u),
          std::min(reach, v),
          std::min(reach, grid.width - u - block.width),
          std::min(reach, grid.height - v - block.height),
          3.0f};
}

TEST(BlockPixels, MeasureAndBidWhatTheirDefinitionsSay) {
  const DepthGrid grid = RoughGrid(29, 27);
  for (const auto& [size, reach] : std::vector<std::pair<int, int>>{{8, 2}, {8, 3}, {5, 2}}) {
    const int count = (size * size + 7) / 8 * 8;
    std::vector<float> residuals(static_cast<std::size_t>(count)), bids(residuals.size());
    int bidding = 0;
    for (int v0 = 0; v0 < grid.height; v0 += size) {
      for (int u0 = 0; u0 < grid.width; u0 += size) {
        const BlockPixels block = BlockAt(grid, u0, v0, size);
        const float least = MeasureBlock(block, count, PixelPlane(kPlane), residuals.data());
        BidForBlock(block, count, PixelPlane(kPlane), WindowOf(grid, block, u0, v0, reach),
                    residuals.data(), bids.data());
        float expected_least = kTooFar;
        for (int v = 0; v < block.height; ++v) {
          for (int u = 0; u < block.width; ++u) {
            const auto i = static_cast<std::size_t>(grid.Index(u0 + u, v0 + v));
            const auto k = static_cast<std::size_t>(v * size + u);
            const float r = grid.g[i] > 0 ? ResidualSigmas(grid, i, kPlane) : kTooFar;
            EXPECT_EQ(residuals[k], r);
            EXPECT_EQ(bids[k], PlainBid(grid, u0 + u, v0 + v, reach, 3.0f));
            expected_least = std::min(expected_least, std::abs(r));
            bidding += bids[k] < kTooFar ? 1 : 0;
          }
        }
        EXPECT_EQ(least, expected_least);
      }
    }
    EXPECT_GT(bidding, 100);
  }
}

std::vector<double> Numbers(const PlaneSums& s) {
  return {s.w, s.wx, s.wy, s.wxx, s.wxy, s.wyy, s.wq, s.wqx, s.wqy, s.wqq};
}

// Columns of one x, and every pixel with its own.
TEST(BlockPixels, SumThePixelsOfALabelAndNoOthersWithALensAndWithout) {
  for (const double k1 : {0.0, 0.2}) {
    const DepthGrid grid = RoughGrid(29, 27, k1);
    ASSERT_EQ(grid.column_x.empty(), k1 != 0.0);
    std::vector<std::int16_t> labels(grid.q.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
      labels[i] = grid.g[i] > 0 ? static_cast<std::int16_t>(i % 5 < 3 ? i % 5 : -1) : kNoLabel;
    const std::vector<PlaneSums> sums = SumLabels(grid, labels, 3);
    std::vector<PlaneSums> plain(3);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == kNoLabel) continue;
      const double g = static_cast<double>(grid.g[i]);
      plain[static_cast<std::size_t>(labels[i])].Add(static_cast<double>(grid.x[i]),
                                                     static_cast<double>(grid.y[i]),
                                                     static_cast<double>(grid.q[i]), g * g);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(sums[k].n, plain[k].n);
      const std::vector<double> got = Numbers(sums[k]), expected = Numbers(plain[k]);
      for (std::size_t m = 0; m < got.size(); ++m)
        EXPECT_NEAR(got[m], expected[m], 1e-12 * plain[k].w) << m;
    }
  }
}

TEST(BlockPixels, OfALabelGoToOneIfAllHaveTheSameAfterwards) {
  const DepthGrid grid = RoughGrid(21, 16);
  for (const int u : {0, 16}) {  // a whole block, and one that the image cuts off
    const BlockPixels block = BlockAt(grid, u, 8, 8);
    std::vector<std::int16_t> from(grid.q.size(), 3), to(grid.q.size(), 7);
    const auto first = static_cast<std::size_t>(grid.Index(u, 8));
    const auto last = static_cast<std::size_t>(grid.Index(u + block.width - 1, 15));
    const auto go = [&](std::int16_t label, std::int16_t& only) {
      return GoToOne(block, from.data() + first, label, to.data() + first, only);
    };
    std::int16_t only = 0;
    from[first] = 5, to[first] = 9;  // another's
    EXPECT_TRUE(go(3, only));
    EXPECT_EQ(only, 7);
    EXPECT_TRUE(go(5, only));
    EXPECT_EQ(only, 9);
    to[last] = kNoLabel;
    EXPECT_FALSE(go(3, only));
    std::fill(to.begin(), to.end(), kNoLabel);
    EXPECT_TRUE(go(3, only));
    EXPECT_EQ(only, kNoLabel);
    to[last] = 8;
    EXPECT_FALSE(go(3, only));
  }
}

TEST(BlockPixels, SeeAJumpOnlyBetweenMeasuredPixelsOfTheBlock) {
  Camera camera;
  camera.width = 17, camera.height = 16;
  const auto jumps = [&](int u, int v, float depth_m) {
    cv::Mat1f depth(16, 17, 1.0f);
    depth(v, u) = depth_m;
    const DepthGrid grid = MakeDepthGrid(depth, PixelRays(camera), DepthNoise{}, 10.0);
    return HasJump(BlockAt(grid, 0, 0, 8), 12.0f);
  };
  for (const auto& [u, v] :
       std::vector<std::pair<int, int>>{{0, 0}, {7, 0}, {0, 7}, {7, 7}, {3, 4}}) {
    EXPECT_TRUE(jumps(u, v, 1.2f)) << u << " " << v;
    EXPECT_FALSE(jumps(u, v, 1.01f)) << u << " " << v;
    EXPECT_FALSE(jumps(u, v, 0.0f)) << u << " " << v;
  }
  EXPECT_FALSE(jumps(8, 3, 1.2f));
  EXPECT_FALSE(jumps(3, 8, 1.2f));
}

}  // namespace
}  // namespace slam
