#include "slam/extract/sight_lines.h"

#include <gtest/gtest.h>

#include "slam/base/camera.h"

namespace slam {
namespace {

/// A wall at 1 m, 64 x 32 pixels, with a strip at another depth from column 24 to 39.
struct StripInFront {
  explicit StripInFront(float strip_m) {
    Camera camera;
    camera.width = 64, camera.height = 32, camera.cx = 31.5, camera.cy = 15.5;
    rays = PixelRays(camera);
    cv::Mat1f depth_m(32, 64, 1.0f);
    depth_m(cv::Rect(24, 0, 16, 32)).setTo(strip_m);
    FillDepthGrid(depth_m, rays, {}, 10.0, grid);
    labels.assign(grid.q.size(), 0);
    for (int v = 0; v < 32; ++v) {
      for (int u = 24; u < 40; ++u) {
        labels[static_cast<std::size_t>(grid.Index(u, v))] = kNoLabel;
      }
    }
    FindComponents(grid, labels, {wall}, components);
    lines.Start(grid, components, labels);
  }
  double ShareBehind() const { return lines.ShareBehind(grid, components, labels, 0, 1, wall); }
  const LabelPlane wall{{0.0, 0.0, 1.0}, 1.0};
  cv::Mat2d rays;
  DepthGrid grid;
  LabelImage labels;
  LabelComponents components;
  SightLines lines;
};

TEST(SightLines, SeeAnOccluderBetweenTwoPartsOfAPlane) {
  const StripInFront strip(0.8f);
  ASSERT_EQ(strip.components.list.size(), 2u);
  EXPECT_EQ(strip.ShareBehind(), 0.0);
}

TEST(SightLines, SeeThatAPlaneEndsWhereWhatIsBetweenLiesBehind) {
  EXPECT_EQ(StripInFront(1.2f).ShareBehind(), 1.0);
}

TEST(SightLines, HoldNothingAgainstAGapWithoutDepth) {
  EXPECT_EQ(StripInFront(0.0f).ShareBehind(), 0.0);
}

}  // namespace
}  // namespace slam
