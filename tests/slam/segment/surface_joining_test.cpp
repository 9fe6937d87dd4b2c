#include "slam/segment/joining/surface_joining.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "slam/geometry/camera.h"
#include "slam/segment/pixels/pixel_labels.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

constexpr int kBlock_px = 8;
using DepthOf = std::function<double(int u, int v)>;

/// Parts of the blocks of an image under noise, whose upright strips of equal width have these labels.
PartsOnBlocks Strips(const DepthOf& depth_of, const std::vector<int>& labels) {
  const Camera camera;
  cv::Mat1f depth_m(camera.height, camera.width);
  for (int v = 0; v < depth_m.rows; ++v)
    for (int u = 0; u < depth_m.cols; ++u) depth_m(v, u) = static_cast<float>(depth_of(u, v));
  const DepthGrid grid =
      MakeDepthGrid(closed_form::AddKinectNoise(depth_m, 1), PixelRays(camera), {}, 10.0);
  PartsOnBlocks on;
  on.Begin(grid.width / kBlock_px, grid.height / kBlock_px);
  for (int r = 0; r < on.rows; ++r) {
    for (int c = 0; c < on.cols; ++c) {
      on.first.push_back(on.parts.size());
      const auto strip =
          static_cast<std::size_t>(c) * labels.size() / static_cast<std::size_t>(on.cols);
      BlockPart part{labels[strip], {}};
      for (int v = 0; v < kBlock_px; ++v)
        for (int u = 0; u < kBlock_px; ++u)
          AddPixel(grid,
                   static_cast<std::size_t>(grid.Index(kBlock_px * c + u, kBlock_px * r + v)),
                   part.sums);
      on.parts.push_back(part);
    }
  }
  on.first.push_back(on.parts.size());
  return on;
}

PartsOnBlocks Halves(const DepthOf& depth_of) { return Strips(depth_of, {0, 1}); }

JoinedLabels Join(const DepthOf& depth_of) {
  return JoinSurfaces(Halves(depth_of), 2, nullptr, {}, {}, {});
}
bool AreJoined(const DepthOf& depth_of) { return Join(depth_of).into[1] == 0; }

/// What a sensor makes of 1 m: 0.33 % of it up and down within 160 columns.
double Bent(int u) { return 1.0 + 0.0033 * std::sqrt(2.0) * std::sin(2.0 * M_PI * u / 160.0); }

TEST(JoinSurfaces, JoinsTheHalvesOfAFlatWall) {
  const JoinedLabels joined = Join([](int, int) { return 1.0; });
  EXPECT_EQ(joined.into, (std::vector<int>{0, 0}));
  EXPECT_EQ(joined.sums[0].n, 640.0 * 480.0);
  EXPECT_EQ(joined.sums[1].n, 0.0);
}

TEST(JoinSurfaces, JoinsTheHalvesOfABentWall) {
  EXPECT_TRUE(AreJoined([](int u, int) { return Bent(u); }));
}

// The bend alone moves the wall by as much as the step, but not within a few pixels.
TEST(JoinSurfaces, KeepsAStepOfTenMillimetresApartOnABentWall) {
  EXPECT_FALSE(AreJoined([](int u, int) { return Bent(u) - (u < 320 ? 0.0 : 0.010); }));
}

// 4 mm are 2.1 standard deviations of a pixel.
TEST(JoinSurfaces, JoinsWhatIsOffByLittleMoreThanThePixelsScatter) {
  EXPECT_TRUE(AreJoined([](int u, int) { return u < 320 ? 1.0 : 1.004; }));
}

TEST(JoinSurfaces, KeepsAStepOfEightMillimetresApart) {
  for (const double z_m : {0.6, 0.8, 1.0})
    EXPECT_FALSE(AreJoined([&](int u, int) { return u < 320 ? z_m : z_m + 0.008; })) << z_m;
}

TEST(JoinSurfaces, CallsASurfaceBentOnlyIfTheSensorBends) {
  const PartsOnBlocks wall = Halves([](int, int) { return 1.0; });
  for (const double ratio : {0.0, kKinectBend}) {
    JoinConfig config;
    config.bend_ratio = ratio;
    EXPECT_EQ(JoinSurfaces(wall, 2, nullptr, {}, {}, config).bent[0], ratio > 0 ? 1 : 0);
  }
}

TEST(JoinSurfaces, KeepsAStepAlongAPartOfTheBorderApart) {
  EXPECT_FALSE(
      AreJoined([](int u, int v) { return 1.0 - (u < 320 || v > 160 ? 0.0 : 0.015); }));
}

TEST(JoinSurfaces, KeepsTheWallsOfACornerApart) {
  EXPECT_FALSE(AreJoined([](int u, int) { return 1.0 + 0.001 * std::abs(u - 320); }));
}

// Nothing is sharp anywhere, but no sensor bends a wall by so much.
TEST(JoinSurfaces, KeepsTheHalvesOfARoundThingApart) {
  EXPECT_FALSE(
      AreJoined([](int u, int) { return 1.0 + 0.08 * std::cos(M_PI * (u - 320.0) / 320.0); }));
}

// Each two neighbours may be one; the left third with both others is too round to be.
TEST(JoinSurfaces, AsksAgainWhatIsOneWithASurfaceThatHasGrown) {
  const auto round = [](int u, int) { return 1.0 + 0.045 * std::pow((u - 450.0) / 320.0, 2); };
  const auto joined = [&](const std::vector<int>& labels) {
    return JoinSurfaces(Strips(round, labels), 3, nullptr, {}, {}, {}).into;
  };
  EXPECT_EQ(joined({0, 1, 2}), (std::vector<int>{0, 1, 1}));
  EXPECT_EQ(joined({0, 2, 1}), (std::vector<int>{0, 1, 1}));
  EXPECT_EQ(joined({1, 2, 0}), (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(joined({2, 1, 0}), (std::vector<int>{0, 0, 2}));
}

TEST(JoinSurfaces, AsksForFourSidesThatTouch) {
  const PartsOnBlocks wall = Halves([](int, int) { return 1.0; });
  for (const int sides : {0, 3, 4}) {
    LabelPairs<int> contacts(2);
    contacts.Of(0, 1) = sides;
    const JoinedLabels joined = JoinSurfaces(wall, 2, &contacts, {}, {}, {});
    EXPECT_EQ(joined.into[1] == 0, sides == 4) << sides;
  }
}

}  // namespace
}  // namespace slam
