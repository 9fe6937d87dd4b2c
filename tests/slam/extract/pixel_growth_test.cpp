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

}  // namespace
}  // namespace slam
