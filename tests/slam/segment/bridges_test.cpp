#include "slam/segment/bridges.h"

#include <gtest/gtest.h>

#include "slam/geometry/camera.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// Two squares of one plane at 1 m, 30 pixels wide and 10 apart, joined by a bridge; what lies
/// around them is `surround_m` away, 0 = not measured.
struct TwoSquares {
  TwoSquares(int bridge_px, float surround_m) {
    Camera camera;
    camera.width = 90, camera.height = 50;
    cv::Mat1f depth_m(50, 90, surround_m);
    labels.assign(50 * 90, kNoLabel);
    const auto fill = [&](const cv::Rect& part) {
      for (int v = part.y; v < part.y + part.height; ++v) {
        for (int u = part.x; u < part.x + part.width; ++u) {
          depth_m(v, u) = 1.0f;
          labels[static_cast<std::size_t>(v * 90 + u)] = 0;
        }
      }
    };
    fill({10, 10, 30, 30});
    fill({50, 10, 30, 30});
    fill({40, 20, 10, bridge_px});
    grid = MakeDepthGrid(depth_m, PixelRays(camera), DepthNoise{}, 10.0);
    FindRuns(labels, grid.width, grid.height, components.runs);
    ConnectRuns(components);
  }
  std::size_t Cut() {
    BridgeCutter().Cut(grid, planes, 0.35, components);
    return components.list.size();
  }

  std::vector<LabelPlane> planes{{InverseDepthPlane{0.0, 0.0, 1.0}, 1.0}};
  LabelImage labels;
  DepthGrid grid;
  LabelComponents components;
};

TEST(Bridges, AreCutWhereWhatLiesBetweenIsBehind) {
  for (const int bridge_px : {1, 2}) {
    TwoSquares squares(bridge_px, 1.05f);
    ASSERT_EQ(squares.components.list.size(), 1u);
    EXPECT_EQ(squares.Cut(), 2u);
    EXPECT_EQ(squares.components.list[0].pixels + squares.components.list[1].pixels,
              2 * 900 + 10 * bridge_px);
    EXPECT_NEAR(squares.components.list[0].pixels, squares.components.list[1].pixels, 20);
    EXPECT_EQ(squares.components.At(20, 20), 0);
    EXPECT_EQ(squares.components.At(60, 20), 1);
    EXPECT_GT(squares.components.list[1].behind, 100);
    EXPECT_EQ(squares.components.list[1].first_pixel, 10 * 90 + 50);
  }
}

TEST(Bridges, StayWhereNothingBehindIsMeasured) {
  EXPECT_EQ(TwoSquares(2, 0.0f).Cut(), 1u);
  EXPECT_EQ(TwoSquares(2, 0.95f).Cut(), 1u) << "something in front hides the plane";
}

TEST(Bridges, AsWideAsASurfaceStay) { EXPECT_EQ(TwoSquares(10, 1.05f).Cut(), 1u); }

}  // namespace
}  // namespace slam
