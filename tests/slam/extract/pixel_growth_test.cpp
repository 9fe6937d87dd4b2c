#include "slam/extract/pixel_growth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/support/closed_form_depth.h"

namespace slam {
namespace {

TEST(PixelGrowth, RefusesBlocksAndReachesThatItHasNoRoomFor) {
  const Camera camera;
  const cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  PixelGrowth growth;
  const auto begin = [&](int block_px, int vote_reach_px) {
    GrowthConfig config;
    config.block_px = block_px, config.vote_reach_px = vote_reach_px;
    growth.Begin(grid, config);
  };
  EXPECT_NO_THROW(begin(64, 16));
  EXPECT_NO_THROW(begin(2, 0));
  EXPECT_THROW(begin(65, 2), std::invalid_argument);
  EXPECT_THROW(begin(1, 2), std::invalid_argument);
  EXPECT_THROW(begin(8, 17), std::invalid_argument);
  EXPECT_THROW(begin(8, -1), std::invalid_argument);
}

TEST(PixelGrowth, TakesThePixelsBackFromAPlaneThatMovedAway) {
  const Camera camera;
  const cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  const auto pixels_of = [&](const PixelGrowth& growth, int label) {
    return std::count(growth.labels().begin(), growth.labels().end(), label);
  };
  PixelGrowth growth;
  growth.Begin(grid, {});
  growth.Seed(0, growth.AddPlane({{0.0, 0.0, 1.0}, 1.0}));
  growth.Grow();
  EXPECT_EQ(pixels_of(growth, 0), camera.width * camera.height);
  growth.Replace({{{0.0, 0.0, 1.02}, 1.0}}, {0});  // 2 cm nearer
  EXPECT_EQ(pixels_of(growth, 0), 0);
  EXPECT_EQ(pixels_of(growth, kNoLabel), camera.width * camera.height);
}

/// Inverse depth that lies so many sigmas nearer than one metre.
double Nearer(const DepthGrid& grid, double sigmas) {
  return 1.0 + sigmas / static_cast<double>(grid.g[0]);
}

// The left half of two blocks' width is of one plane, the right half 3.5 sigmas nearer, so that
// each half's plane is the other's next best.
TEST(PixelGrowth, DropsAPlaneOnceABetterOneHasComeToBlocksWhoseGainsWereKnown) {
  Camera camera;
  camera.width = 16, camera.height = 16;
  cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  const DepthGrid flat = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  depth_m.colRange(8, 16) = static_cast<float>(1.0 / Nearer(flat, 3.5));
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  PixelGrowth growth;
  growth.Begin(grid, {});
  const auto add = [&](int block, double sigmas) {
    const int label = growth.AddPlane({{0.0, 0.0, Nearer(grid, sigmas)}, 1.0});
    growth.Seed(block, label);
    growth.Grow();
    growth.DropUseless();
    return label;
  };
  const int right = add(1, 3.5), near = add(0, 1.0);
  EXPECT_EQ(growth.labels()[0], near);
  EXPECT_EQ(growth.labels()[15], right);
  const int exact = add(0, 0.0);
  EXPECT_EQ(growth.labels()[0], exact);
  EXPECT_EQ(growth.labels()[15], right);
}

TEST(PixelGrowth, SumsOtherLabelsOfItsPixelsAsIfTheyWereCountedOneByOne) {
  Camera camera;
  camera.width = 61, camera.height = 45;
  cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  depth_m(cv::Rect(20, 10, 25, 25)) = 0.9f;
  depth_m(3, 3) = 0.0f;
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  PixelGrowth growth;
  growth.Begin(grid, {});
  growth.Seed(growth.BlockAt(0, 0), growth.AddPlane({{0.0, 0.0, 1.0}, 1.0}));
  growth.Seed(growth.BlockAt(30, 20), growth.AddPlane({{0.0, 0.0, 1.0 / 0.9}, 1.0}));
  growth.Grow();
  growth.SumLabels({});
  LabelImage other = growth.labels();
  for (std::size_t i = 0; i < other.size(); ++i) {
    const std::size_t u = i % 61, v = i / 61;
    if (other[i] == 1) other[i] = 0;
    if (v > 30) other[i] = other[i] == kNoLabel ? kNoLabel : std::int16_t{2};
    if (u > 50 && v > 35) other[i] = kNoLabel;
    if (u < 8 && v < 8 && other[i] == 0) other[i] = 1;
  }
  std::vector<PlaneSums> sums;
  growth.SumOtherLabels(other, 3, sums);
  const std::vector<PlaneSums> plain = SumLabels(grid, other, 3);
  ASSERT_EQ(sums.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(sums[k].n, plain[k].n) << k;
    EXPECT_NEAR(sums[k].wqx, plain[k].wqx, 1e-12 * plain[k].w) << k;
  }
}

}  // namespace
}  // namespace slam
