#include "slam/segment/growth/pixel_growth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "slam/segment/clusters/block_clusters.h"
#include "tests/slam/segment/pixel_sets.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

LabelImage LabelsOf(PixelGrowth& growth, const DepthGrid& grid) {
  LabelImage labels;
  growth.DrawLabels(grid.width, grid.height, labels);
  return labels;
}

TEST(PixelGrowth, TakesThePixelsBackFromAPlaneThatMovedAway) {
  const Camera camera;
  const cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  const auto pixels_of = [&](PixelGrowth& growth, int label) {
    const LabelImage labels = LabelsOf(growth, grid);
    return std::count(labels.begin(), labels.end(), label);
  };
  const ImageBlocks blocks = MakeBlocks(grid);
  PixelGrowth growth;
  growth.Begin(blocks, {});
  growth.Seed(0, growth.AddPlane({{0.0, 0.0, 1.0}, 1.0}, {}));
  growth.Grow();
  EXPECT_EQ(pixels_of(growth, 0), camera.width * camera.height);
  growth.Replace({{{0.0, 0.0, 1.02}, 1.0}}, {0}, {{}});  // 2 cm nearer
  EXPECT_EQ(pixels_of(growth, 0), 0);
  EXPECT_EQ(pixels_of(growth, kNoLabel), camera.width * camera.height);
}

/// Inverse depth that lies so many sigmas nearer than one metre.
double Nearer(const DepthGrid& grid, double sigmas) {
  return 1.0 + sigmas / static_cast<double>(grid.g[0]);
}

// The left half of two blocks' width is of one plane, the right half 3.5 sigmas
// nearer, so that each half's plane is the other's next best.
TEST(PixelGrowth, DropsAPlaneOnceABetterOneHasComeToBlocksWhoseGainsWereKnown) {
  Camera camera;
  camera.width = 16, camera.height = 16;
  cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  const DepthGrid flat = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  depth_m.colRange(8, 16) = static_cast<float>(1.0 / Nearer(flat, 3.5));
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  const ImageBlocks blocks = MakeBlocks(grid);
  PixelGrowth growth;
  growth.Begin(blocks, {});
  const auto add = [&](int block, double sigmas) {
    const int label = growth.AddPlane({{0.0, 0.0, Nearer(grid, sigmas)}, 1.0}, {});
    growth.Seed(block, label);
    growth.Grow();
    growth.DropUseless();
    return label;
  };
  const int right = add(1, 3.5), near = add(0, 1.0);
  EXPECT_EQ(LabelsOf(growth, grid)[0], near);
  EXPECT_EQ(LabelsOf(growth, grid)[15], right);
  const int exact = add(0, 0.0);
  EXPECT_EQ(LabelsOf(growth, grid)[0], exact);
  EXPECT_EQ(LabelsOf(growth, grid)[15], right);
}

TEST(PixelGrowth, SumsLabelsAsIfTheirPixelsWereCountedOneByOne) {
  Camera camera;
  camera.width = 61, camera.height = 45;
  cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  depth_m(cv::Rect(20, 10, 25, 25)) = 0.9f;
  depth_m(3, 3) = 0.0f;
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  const ImageBlocks blocks = MakeBlocks(grid);
  PixelGrowth growth;
  growth.Begin(blocks, {});
  growth.Seed(0, growth.AddPlane({{0.0, 0.0, 1.0}, 1.0}, {}));
  growth.Seed(2 * blocks.cols + 3, growth.AddPlane({{0.0, 0.0, 1.0 / 0.9}, 1.0}, {}));
  growth.Grow();
  const std::vector<PlaneSums> plain = SumLabels(grid, LabelsOf(growth, grid), 2);
  const BlockClusters clusters =
      BlockClustering().Cluster(blocks, blocks.measured, kBlock_px, {}, {});
  PartsOnBlocks parts;
  growth.SumParts(clusters.block_sums, parts);
  const std::vector<PlaneSums> sums = SumParts(parts, 2);
  ASSERT_EQ(sums.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(sums[k].n, plain[k].n) << k;
    EXPECT_NEAR(sums[k].wqx, plain[k].wqx, 1e-12 * plain[k].w) << k;
  }
}

/// Two crossing slopes and a step under noise, with holes.
DepthGrid RandomGrid(int side, std::mt19937& random) {
  Camera camera;
  camera.width = side, camera.height = side;
  camera.cx = camera.cy = 0.5 * side;
  std::normal_distribution<float> noise(0.0f, 0.0019f);
  std::uniform_real_distribution<float> slope(-0.004f, 0.004f);
  const float a = slope(random), b = slope(random);
  cv::Mat1f depth_m(side, side);
  for (int v = 0; v < side; ++v) {
    for (int u = 0; u < side; ++u) {
      const float left = a * static_cast<float>(u - side / 2);
      const float top = b * static_cast<float>(v - side / 2);
      depth_m(v, u) =
          1.0f + std::max(left, top) + (u + v > 3 * side / 2 ? 0.02f : 0.0f) + noise(random);
      if (random() % 40 == 0) depth_m(v, u) = 0.0f;
    }
  }
  return MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
}

/// Planes through it, some of them nearly the same.
std::vector<LabelPlane> RandomPlanes(std::mt19937& random) {
  std::uniform_real_distribution<double> tilt(-0.6, 0.6), offset(-0.006, 0.006),
      grazing(1.0, 1.3);
  std::vector<LabelPlane> planes;
  for (int k = 0; k < 5; ++k)
    planes.push_back({{tilt(random), tilt(random), 1.0 + offset(random)}, grazing(random)});
  LabelPlane twin = planes[0];
  twin.plane.c += 0.3 * offset(random);
  planes.push_back(twin);
  return planes;
}

/// Grown from every block.
void GrowEverywhere(const ImageBlocks& blocks, const GrowthConfig& config,
                    const std::vector<LabelPlane>& planes, PixelGrowth& growth) {
  growth.Begin(blocks, config);
  for (const LabelPlane& plane : planes) {
    const int label = growth.AddPlane(plane, {});
    for (int block = 0; block < blocks.count(); ++block) growth.Seed(block, label);
  }
  growth.Grow();
}

double Residual(const DepthGrid& grid, std::size_t i, const LabelPlane& plane) {
  return std::abs(static_cast<double>(ResidualSigmas(grid, i, PixelPlane(plane))));
}

/// What the vote says of every pixel.
LabelImage PlainLabels(const DepthGrid& grid, const std::vector<LabelPlane>& planes) {
  LabelImage labels(grid.q.size(), kNoLabel);
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < planes.size() && grid.g[i] > 0; ++k) {
        if (Residual(grid, i, planes[k]) >= 3.0) continue;
        double cost = 0.0;
        for (int y = std::max(v - 2, 0); y <= std::min(v + 2, grid.height - 1); ++y) {
          for (int x = std::max(u - 2, 0); x <= std::min(u + 2, grid.width - 1); ++x) {
            const double r =
                Residual(grid, static_cast<std::size_t>(grid.Index(x, y)), planes[k]);
            cost += std::min(r * r, 9.0);
          }
        }
        if (cost < least) least = cost, labels[i] = static_cast<std::int16_t>(k);
      }
    }
  }
  return labels;
}

// Images of whole blocks and others.
TEST(PixelGrowth, GivesEveryPixelToTheBestOfThePlanesNearItWhateverTheBlocks) {
  std::mt19937 random(3);
  for (const int side : {32, 35, 29}) {
    for (int turn = 0; turn < 10; ++turn) {
      const DepthGrid grid = RandomGrid(side, random);
      const ImageBlocks blocks = MakeBlocks(grid);
      const std::vector<LabelPlane> planes = RandomPlanes(random);
      const LabelImage expected = PlainLabels(grid, planes);
      EXPECT_GT(std::set<int>(expected.begin(), expected.end()).size(), 4u);
      PixelGrowth growth;
      GrowEverywhere(blocks, {}, planes, growth);
      EXPECT_EQ(LabelsOf(growth, grid), expected) << side;
    }
  }
}

/// Without planes that gain too little, by definition: smallest first, over the
/// next best, or as if there were none where that is dropped.
std::vector<LabelPlane> PlainlyUseful(const DepthGrid& grid, std::vector<LabelPlane> planes,
                                      double min_gain) {
  const LabelImage labels = PlainLabels(grid, planes);
  std::vector<std::pair<long, std::size_t>> by_pixels;
  for (std::size_t k = 0; k < planes.size(); ++k)
    by_pixels.emplace_back(std::count(labels.begin(), labels.end(), static_cast<int>(k)), k);
  std::sort(by_pixels.begin(), by_pixels.end());
  std::vector<bool> dropped(planes.size());
  for (const auto& [pixels, k] : by_pixels) {
    double gain = 0.0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] != static_cast<int>(k)) continue;
      double next = 4.0;
      bool is_dropped = false;
      for (std::size_t other = 0; other < planes.size(); ++other) {
        const double r = Residual(grid, i, planes[other]);
        if (other != k && r < next) next = r, is_dropped = dropped[other];
      }
      if (is_dropped) next = 4.0;
      const double own = Residual(grid, i, planes[k]);
      gain += next * next - own * own;
    }
    dropped[k] = gain < min_gain * static_cast<double>(std::max(pixels, 1L));
  }
  std::vector<LabelPlane> useful;
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (!dropped[k]) useful.push_back(planes[k]);
  return useful;
}

TEST(PixelGrowth, DropsThePlanesWhoseGainIsTooLittleAlsoIfItIsOnlyBounded) {
  std::mt19937 random(4);
  int turns_with_useless = 0, turns_with_useful = 0;
  for (int turn = 0; turn < 30; ++turn) {
    const DepthGrid grid = RandomGrid(32, random);
    const ImageBlocks blocks = MakeBlocks(grid);
    const std::vector<LabelPlane> planes = RandomPlanes(random);
    for (const double min_gain : {0.5, 3.0, 6.0}) {
      GrowthConfig config;
      config.min_gain = min_gain;
      PixelGrowth growth;
      GrowEverywhere(blocks, config, planes, growth);
      growth.DropUseless();
      const std::vector<LabelPlane> useful = PlainlyUseful(grid, planes, min_gain);
      const LabelImage expected = PlainLabels(grid, useful);
      turns_with_useless += useful.size() < planes.size() ? 1 : 0;
      turns_with_useful += useful.size() > 1 ? 1 : 0;
      // Labels have other numbers without the others.
      const LabelImage labels = LabelsOf(growth, grid);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const int label = labels[i];
        ASSERT_EQ(label == kNoLabel, expected[i] == kNoLabel);
        if (label == kNoLabel) continue;
        const InverseDepthPlane &is = planes[static_cast<std::size_t>(label)].plane,
                                &should = useful[static_cast<std::size_t>(expected[i])].plane;
        ASSERT_EQ(is.a, should.a);
        ASSERT_EQ(is.c, should.c);
      }
    }
  }
  EXPECT_GT(turns_with_useless, 10);
  EXPECT_GT(turns_with_useful, 10);
}

// Two sigmas away it gains 16 - 4 a pixel, of which the bound promises 16 - 9.
TEST(PixelGrowth, DropsAPlaneThatGainsTooLittleThoughNoOtherIsNear) {
  Camera camera;
  camera.width = 24, camera.height = 8;
  const cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  for (const auto& [min_gain, stays] :
       std::vector<std::pair<double, bool>>{{6.9, true}, {11.9, true}, {12.1, false}}) {
    GrowthConfig config;
    config.min_gain = min_gain;
    const ImageBlocks blocks = MakeBlocks(grid);
    PixelGrowth growth;
    growth.Begin(blocks, config);
    for (const double sigmas : {2.0, 20.0}) {
      const int label = growth.AddPlane({{0.0, 0.0, Nearer(grid, sigmas)}, 1.0}, {});
      for (int block = 0; block < 3; ++block) growth.Seed(block, label);
    }
    growth.Grow();
    EXPECT_EQ(LabelsOf(growth, grid)[0], 0);
    growth.DropUseless();
    EXPECT_EQ(LabelsOf(growth, grid)[0] == 0, stays) << min_gain;
  }
}

TEST(PixelGrowth, HasTheSameLabelsHoweverOftenItIsAskedAndWhateverItHeldBefore) {
  std::mt19937 random(6);
  PixelGrowth again;
  for (int turn = 0; turn < 5; ++turn) {
    const DepthGrid grid = RandomGrid(40, random);
    const ImageBlocks blocks = MakeBlocks(grid);
    const std::vector<LabelPlane> planes = RandomPlanes(random);
    PixelGrowth once;
    const auto run = [&](PixelGrowth& growth, bool ask) {
      GrowEverywhere(blocks, {}, planes, growth);
      if (ask) LabelsOf(growth, grid);
      growth.DropUseless();
      if (ask) LabelsOf(growth, grid);
      std::vector<LabelPlane> moved = planes;
      for (LabelPlane& plane : moved) plane.plane.c += 0.01;
      growth.Replace(moved, {0, 1, 2, 3, 4, 0}, std::vector<std::vector<LabelPlane>>(6));
      return LabelsOf(growth, grid);
    };
    EXPECT_EQ(run(again, true), run(once, false));
  }
}

TEST(PixelGrowth, LeavesUnexplainedWhatLiesOffItsPlaneAndWhatHasNone) {
  Camera camera;
  camera.width = 24, camera.height = 8;
  cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  const DepthGrid flat = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  depth_m.colRange(8, 16) = static_cast<float>(1.0 / Nearer(flat, 2.0));
  depth_m.colRange(16, 24) = 0.5f;
  depth_m(3, 20) = 0.0f;
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  const ImageBlocks blocks = MakeBlocks(grid);
  PixelGrowth growth;
  growth.Begin(blocks, {});
  growth.Seed(0, growth.AddPlane({{0.0, 0.0, 1.0}, 1.0}, {}));
  growth.Grow();
  // At most 1 + 1 / 8 sigmas.
  const std::vector<PixelSet> unexplained = growth.FindUnexplained(1.0, 1.0);
  ASSERT_EQ(unexplained.size(), 3u);
  EXPECT_EQ(unexplained[0], 0u);
  EXPECT_EQ(unexplained[1], ~PixelSet{0});
  EXPECT_EQ(unexplained[2], ~PixelOf(4, 3));
}

}  // namespace
}  // namespace slam
