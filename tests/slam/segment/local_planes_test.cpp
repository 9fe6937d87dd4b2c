#include "slam/segment/joining/local_planes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/geometry/camera.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// The left half of a wall at 1 m that is bent along the columns.
class BentWall : public ::testing::Test {
 protected:
  void SetUp() override {
    const Camera camera;
    cv::Mat1f depth_m(camera.height, camera.width);
    for (int u = 0; u < depth_m.cols; ++u)
      depth_m.col(u) = static_cast<float>(1.0 / InverseDepth(u));
    grid_ = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
    parts_.Begin(grid_.width / kBlock_px, grid_.height / kBlock_px);
    for (int r = 0; r < parts_.rows; ++r) {
      for (int c = 0; c < parts_.cols; ++c) {
        parts_.first.push_back(parts_.parts.size());
        if (2 * c >= parts_.cols) continue;
        BlockPart part;
        for (int v = 0; v < kBlock_px; ++v)
          for (int u = 0; u < kBlock_px; ++u)
            AddPixel(grid_, Pixel(kBlock_px * c + u, kBlock_px * r + v), part.sums);
        parts_.parts.push_back(part);
      }
    }
    parts_.first.push_back(parts_.parts.size());
    planes_ = FitLocally(parts_, {0}, 0, plane_, {}, {});
  }
  static double InverseDepth(int u) { return 1.0 + 0.0047 * std::sin(2.0 * M_PI * u / 160.0); }
  std::size_t Pixel(int u, int v) const { return static_cast<std::size_t>(grid_.Index(u, v)); }
  const LabelPlane& At(int u, int v) const {
    const int tile_px = kTile_blocks * kBlock_px;
    return planes_[static_cast<std::size_t>(v / tile_px * TileCount(parts_.cols) +
                                            u / tile_px)];
  }

  DepthGrid grid_;
  PartsOnBlocks parts_;
  const LabelPlane plane_{{0.0, 0.0, 1.0}, 1.0};
  std::vector<LabelPlane> planes_;
};

TEST_F(BentWall, IsWithinHalfASigmaOfItsLocalPlanes) {
  for (int u = 4; u < 310; u += 3)
    EXPECT_LT(std::abs(ResidualSigmas(grid_, Pixel(u, 200), PixelPlane(At(u, 200)))), 0.5f)
        << u;
}

TEST_F(BentWall, HasItsOwnPlaneWhereNothingOfItIsNear) {
  EXPECT_EQ(At(400, 200).plane.a, plane_.plane.a);
  EXPECT_EQ(At(400, 200).plane.c, plane_.plane.c);
}

}  // namespace
}  // namespace slam
