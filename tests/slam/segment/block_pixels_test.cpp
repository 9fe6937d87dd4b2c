#include "slam/segment/pixels/block_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "slam/geometry/camera.h"
#include "tests/slam/segment/pixel_sets.h"
#include "tests/support/depth_planes.h"

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

float ResidualAt(const DepthGrid& grid, int u, int v) {
  return ResidualSigmas(grid, static_cast<std::size_t>(grid.Index(u, v)), PixelPlane(kPlane));
}
bool IsMeasured(const DepthGrid& grid, int u, int v) {
  return grid.g[static_cast<std::size_t>(grid.Index(u, v))] > 0;
}

/// What a cost is by its definition.
float PlainCost(const DepthGrid& grid, int u, int v, float most) {
  constexpr int reach = kVoteReach_px;
  float cost = 0.0f;
  for (int y = std::max(v - reach, 0); y <= std::min(v + reach, grid.height - 1); ++y) {
    for (int x = std::max(u - reach, 0); x <= std::min(u + reach, grid.width - 1); ++x) {
      const float r = ResidualAt(grid, x, y);
      cost += std::min(r * r, most * most);
    }
  }
  return cost;
}

/// Calls visit(block, u0, v0) for the blocks of a grid, whole and cut off by
/// the image.
template <typename Visit>
void VisitBlocks(const DepthGrid& grid, const Visit& visit) {
  const ImageBlocks blocks = MakeBlocks(grid);
  for (int k = 0; k < blocks.count(); ++k)
    visit(blocks.PixelsOf(k), k % blocks.cols * kBlock_px, k / blocks.cols * kBlock_px);
}

TEST(BlockPixels, FindWhatIsNearAPlaneAndItsCostsAsTheirDefinitionsSay) {
  for (const double k1 : {0.0, 0.2}) {
    const DepthGrid grid = RoughGrid(29, 27, k1);
    int with_costs = 0, only_wide = 0;
    VisitBlocks(grid, [&](const BlockPixels& block, int u0, int v0) {
      std::vector<float> costs(kBlockPixels);
      const PixelSet measured = FindMeasured(block);
      const auto [near, wide] = FindNear(block, PixelPlane(kPlane), measured, 3.0f, 4.0f);
      FindCosts(block, PixelPlane(kPlane), 3.0f, near, costs.data());
      for (int v = 0; v < kBlock_px; ++v) {
        for (int u = 0; u < kBlock_px; ++u) {
          const bool inside =
              u < block.width && v < block.height && IsMeasured(grid, u0 + u, v0 + v);
          const float r = inside ? std::abs(ResidualAt(grid, u0 + u, v0 + v)) : kTooFar;
          const float cost = costs[static_cast<std::size_t>(v * kBlock_px + u)];
          EXPECT_EQ(IsInSet(measured, u, v), inside);
          EXPECT_EQ(IsInSet(near, u, v), r < 3.0f) << r;
          EXPECT_EQ(IsInSet(wide, u, v), r < 4.0f) << r;
          if (r < 3.0f) {
            const float plain = PlainCost(grid, u0 + u, v0 + v, 3.0f);
            EXPECT_NEAR(cost, plain, 1e-5f * plain);
            ++with_costs;
          } else {
            EXPECT_EQ(cost, kTooFar);
            only_wide += r < 4.0f ? 1 : 0;
          }
        }
      }
    });
    EXPECT_GT(with_costs, 100);
    EXPECT_GT(only_wide, 10);
  }
}

TEST(BlockPixels, SumResidualsAndGainsOfTheirSetAlone) {
  for (const double k1 : {0.0, 0.2}) {
    const DepthGrid grid = RoughGrid(29, 27, k1);
    VisitBlocks(grid, [&](const BlockPixels& block, int u0, int v0) {
      PixelSet set = 0;
      std::vector<float> nearest(kBlockPixels, 4.0f);
      LowerToDistance(block, PixelPlane(kPlane), nearest.data());
      double residuals = 0.0, gains = 0.0;
      for (int v = 0; v < block.height; ++v) {
        for (int u = 0; u < block.width; ++u) {
          const float r = ResidualAt(grid, u0 + u, v0 + v);
          float& least = nearest[static_cast<std::size_t>(v * kBlock_px + u)];
          EXPECT_NEAR(least, std::min(std::abs(r), 4.0f), 1e-5f);
          least = 5.0f;
          if ((u * 7 + v * 3) % 5 > 1 || !IsMeasured(grid, u0 + u, v0 + v)) continue;
          set |= PixelOf(u, v);
          residuals += static_cast<double>(r);
          gains += 25.0 - static_cast<double>(r * r);
        }
      }
      EXPECT_NEAR(SumResiduals(block, PixelPlane(kPlane), set), residuals, 1e-5 * kBlockPixels);
      EXPECT_NEAR(SumGains(block, PixelPlane(kPlane), set, nearest.data()), gains,
                  1e-3 * kBlockPixels);
    });
  }
}

std::vector<double> Numbers(const PlaneSums& s) {
  return {s.w, s.wx, s.wy, s.wxx, s.wxy, s.wyy, s.wq, s.wqx, s.wqy, s.wqq};
}

// Columns of one x, and every pixel with its own; whole blocks and their
// quarters.
TEST(BlockPixels, SumTheirSetAloneWithALensAndWithout) {
  for (const double k1 : {0.0, 0.2}) {
    const DepthGrid grid = RoughGrid(29, 27, k1);
    ASSERT_EQ(grid.column_x.empty(), k1 != 0.0);
    for (const PixelSet own :
         {kWholeBlock, QuarterAt(0, 0), QuarterAt(4, 0), QuarterAt(0, 4), QuarterAt(4, 4)}) {
      VisitBlocks(grid, [&](const BlockPixels& block, int u0, int v0) {
        PixelSet set = 0;
        PlaneSums plain;
        for (int v = 0; v < block.height; ++v) {
          for (int u = 0; u < block.width; ++u) {
            const auto i = static_cast<std::size_t>(grid.Index(u0 + u, v0 + v));
            if (!(grid.g[i] > 0) || (u * 5 + v) % 3 == 0 || !IsInSet(own, u, v)) continue;
            set |= PixelOf(u, v);
            AddPixel(grid, i, plain);
          }
        }
        const PlaneSums sums = SumOfSet(block, set);
        EXPECT_EQ(sums.n, plain.n);
        const std::vector<double> got = Numbers(sums), expected = Numbers(plain);
        for (std::size_t m = 0; m < got.size(); ++m)
          EXPECT_NEAR(got[m], expected[m], 1e-12 * plain.w) << m;
      });
    }
  }
}

TEST(BlockPixels, SeeAJumpOnlyBetweenMeasuredPixelsOfTheBlock) {
  Camera camera;
  camera.width = 17, camera.height = 16;
  const auto jumps = [&](int u, int v, float depth_m, PixelSet within = kWholeBlock) {
    cv::Mat1f depth(16, 17, 1.0f);
    depth(v, u) = depth_m;
    const DepthGrid grid = MakeDepthGrid(depth, PixelRays(camera), DepthNoise{}, 10.0);
    return HasJump(MakeBlocks(grid).pixels.front(), 12.0f, within);
  };
  for (const auto& [u, v] :
       std::vector<std::pair<int, int>>{{0, 0}, {7, 0}, {0, 7}, {7, 7}, {3, 4}}) {
    EXPECT_TRUE(jumps(u, v, 1.2f)) << u << " " << v;
    EXPECT_FALSE(jumps(u, v, 1.01f)) << u << " " << v;
    EXPECT_FALSE(jumps(u, v, 0.0f)) << u << " " << v;
  }
  EXPECT_FALSE(jumps(8, 3, 1.2f));
  EXPECT_FALSE(jumps(3, 8, 1.2f));
  // In a quarter alone.
  EXPECT_TRUE(jumps(4, 3, 1.2f, QuarterAt(4, 0)));
  EXPECT_TRUE(jumps(7, 0, 1.2f, QuarterAt(4, 0)));
  EXPECT_FALSE(jumps(3, 3, 1.2f, QuarterAt(4, 0)));
  EXPECT_FALSE(jumps(4, 4, 1.2f, QuarterAt(4, 0)));
}

}  // namespace
}  // namespace slam
