#include "slam/segment/block_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "slam/geometry/camera.h"
#include "slam/segment/block_sums.h"
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
  return ResidualSigmas(grid, static_cast<std::size_t>(grid.Index(u, v)), kPlane);
}
bool IsMeasured(const DepthGrid& grid, int u, int v) {
  return grid.g[static_cast<std::size_t>(grid.Index(u, v))] > 0;
}

/// What a cost is by its definition.
float PlainCost(const DepthGrid& grid, int u, int v, int reach, float most) {
  float cost = 0.0f;
  for (int y = std::max(v - reach, 0); y <= std::min(v + reach, grid.height - 1); ++y) {
    for (int x = std::max(u - reach, 0); x <= std::min(u + reach, grid.width - 1); ++x) {
      const float r = ResidualAt(grid, x, y);
      cost += std::min(r * r, most * most);
    }
  }
  return cost;
}

CostWindow WindowOf(const DepthGrid& grid, const BlockPixels& block, int u, int v, int reach) {
  return {reach,
          std::min(reach, u),
          std::min(reach, v),
          std::min(reach, grid.width - u - block.width),
          std::min(reach, grid.height - v - block.height),
          3.0f};
}

/// Calls visit(block, u0, v0) for the blocks of a grid, whole and cut off by the image.
template <typename Visit>
void VisitBlocks(const DepthGrid& grid, int size, const Visit& visit) {
  for (int v0 = 0; v0 < grid.height; v0 += size)
    for (int u0 = 0; u0 < grid.width; u0 += size) visit(BlockAt(grid, u0, v0, size), u0, v0);
}

TEST(BlockPixels, FindWhatIsNearAPlaneAndItsCostsAsTheirDefinitionsSay) {
  for (const double k1 : {0.0, 0.2}) {
    const DepthGrid grid = RoughGrid(29, 27, k1);
    for (const auto& [size, reach] :
         std::vector<std::pair<int, int>>{{8, 2}, {8, 3}, {5, 2}, {11, 2}}) {
      const std::size_t words = WordsOfSet(size);
      std::vector<float> costs(EntriesOfBlock(size));
      std::vector<std::uint64_t> measured(words), near(words), wide(words);
      int with_costs = 0, only_wide = 0;
      VisitBlocks(grid, size, [&](const BlockPixels& block, int u0, int v0) {
        FindMeasured(block, measured.data());
        const int found = FindNear(block, PixelPlane(kPlane), measured.data(), 3.0f, 4.0f,
                                   near.data(), wide.data());
        FindCosts(block, PixelPlane(kPlane), WindowOf(grid, block, u0, v0, reach), near.data(),
                  costs.data());
        int expected = 0;
        for (int v = 0; v < size; ++v) {
          for (int u = 0; u < size; ++u) {
            const bool inside =
                u < block.width && v < block.height && IsMeasured(grid, u0 + u, v0 + v);
            const float r = inside ? std::abs(ResidualAt(grid, u0 + u, v0 + v)) : kTooFar;
            const float cost = costs[static_cast<std::size_t>(v * size + u)];
            EXPECT_EQ(IsInSet(measured.data(), size, u, v), inside);
            EXPECT_EQ(IsInSet(near.data(), size, u, v), r < 3.0f) << r;
            EXPECT_EQ(IsInSet(wide.data(), size, u, v), r < 4.0f) << r;
            if (r < 3.0f) {
              const float plain = PlainCost(grid, u0 + u, v0 + v, reach, 3.0f);
              EXPECT_NEAR(cost, plain, 1e-5f * plain);
              ++expected;
            } else {
              EXPECT_EQ(cost, kTooFar);
              only_wide += r < 4.0f ? 1 : 0;
            }
          }
        }
        EXPECT_EQ(found, expected);
        with_costs += expected;
      });
      EXPECT_GT(with_costs, 100);
      EXPECT_GT(only_wide, 10);
    }
  }
}

TEST(BlockPixels, SumResidualsAndGainsOfTheirSetAlone) {
  for (const double k1 : {0.0, 0.2}) {
    const DepthGrid grid = RoughGrid(29, 27, k1);
    for (const int size : {8, 5, 11}) {
      const std::size_t words = WordsOfSet(size);
      VisitBlocks(grid, size, [&](const BlockPixels& block, int u0, int v0) {
        std::vector<std::uint64_t> set(words);
        std::vector<float> nearest(static_cast<std::size_t>(size * size + 7), 4.0f);
        LowerToDistance(block, PixelPlane(kPlane), nearest.data());
        double residuals = 0.0, gains = 0.0;
        for (int v = 0; v < block.height; ++v) {
          for (int u = 0; u < block.width; ++u) {
            const float r = ResidualAt(grid, u0 + u, v0 + v);
            float& least = nearest[static_cast<std::size_t>(v * size + u)];
            EXPECT_NEAR(least, std::min(std::abs(r), 4.0f), 1e-5f);
            least = 5.0f;
            if ((u * 7 + v * 3) % 5 > 1 || !IsMeasured(grid, u0 + u, v0 + v)) continue;
            PutInSet(set.data(), size, u, v);
            residuals += static_cast<double>(r);
            gains += 25.0 - static_cast<double>(r * r);
          }
        }
        EXPECT_NEAR(SumResiduals(block, PixelPlane(kPlane), set.data()), residuals,
                    1e-5 * size * size);
        EXPECT_NEAR(SumGains(block, PixelPlane(kPlane), set.data(), nearest.data()), gains,
                    1e-3 * size * size);
      });
    }
  }
}

std::vector<double> Numbers(const PlaneSums& s) {
  return {s.w, s.wx, s.wy, s.wxx, s.wxy, s.wyy, s.wq, s.wqx, s.wqy, s.wqq};
}

// Columns of one x, and every pixel with its own.
TEST(BlockPixels, SumThePixelsThatAreNotTakenWithALensAndWithout) {
  for (const double k1 : {0.0, 0.2}) {
    const DepthGrid grid = RoughGrid(29, 27, k1);
    ASSERT_EQ(grid.column_x.empty(), k1 != 0.0);
    std::vector<std::uint8_t> taken(grid.q.size());
    for (std::size_t i = 0; i < taken.size(); ++i)
      taken[i] = static_cast<std::uint8_t>(i % 5 < 3 ? 0 : i % 5);
    VisitBlocks(grid, 8, [&](const BlockPixels& block, int u0, int v0) {
      PlaneSums plain;
      for (int v = 0; v < block.height; ++v) {
        for (int u = 0; u < block.width; ++u) {
          const auto i = static_cast<std::size_t>(grid.Index(u0 + u, v0 + v));
          const double g = static_cast<double>(grid.g[i]);
          if (!(g > 0) || taken[i] != 0) continue;
          plain.Add(static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]),
                    static_cast<double>(grid.q[i]), g * g);
        }
      }
      const PlaneSums sums = SumFree(block, taken.data() + grid.Index(u0, v0));
      EXPECT_EQ(sums.n, plain.n);
      const std::vector<double> got = Numbers(sums), expected = Numbers(plain);
      for (std::size_t m = 0; m < got.size(); ++m)
        EXPECT_NEAR(got[m], expected[m], 1e-12 * plain.w) << m;
    });
  }
}

TEST(BlockPixels, SumTheirSetAlone) {
  for (const double k1 : {0.0, 0.2}) {
    const DepthGrid grid = RoughGrid(29, 27, k1);
    for (const int size : {8, 5}) {
      VisitBlocks(grid, size, [&](const BlockPixels& block, int u0, int v0) {
        std::vector<std::uint64_t> all(WordsOfSet(size)), set(all);
        PlaneSums plain_all, plain_set;
        FindMeasured(block, all.data());
        for (int v = 0; v < block.height; ++v) {
          for (int u = 0; u < block.width; ++u) {
            const auto i = static_cast<std::size_t>(grid.Index(u0 + u, v0 + v));
            const double g = static_cast<double>(grid.g[i]);
            if (!(g > 0)) continue;
            const auto add = [&](PlaneSums& sums) {
              sums.Add(static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]),
                       static_cast<double>(grid.q[i]), g * g);
            };
            add(plain_all);
            if ((u * 5 + v) % 3 == 0) continue;
            PutInSet(set.data(), size, u, v);
            add(plain_set);
          }
        }
        for (const auto& [got, expected] :
             {std::pair(SumBlock(block, all.data()), plain_all),
              std::pair(SumOfSet(block, set.data()), plain_set)}) {
          EXPECT_EQ(got.n, expected.n);
          const std::vector<double> a = Numbers(got), b = Numbers(expected);
          for (std::size_t m = 0; m < a.size(); ++m)
            EXPECT_NEAR(a[m], b[m], 1e-12 * expected.w) << m;
        }
      });
    }
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
