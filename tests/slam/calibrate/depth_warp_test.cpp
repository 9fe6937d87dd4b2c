#include "slam/calibrate/depth_warp.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace slam {
namespace {

TEST(DepthWarp, CellsArePartsOfTheViewWhateverTheSizeOfTheImage) {
  Camera large, small;
  small.width = 320, small.height = 240, small.fx = small.fy = 262.5;
  const WarpCells a = CellsOf(large), b = CellsOf(small);
  EXPECT_EQ(a.cols, 32);
  EXPECT_EQ(a.rows, 24);
  EXPECT_EQ(b.cols, a.cols);
  EXPECT_EQ(b.rows, a.rows);
  EXPECT_EQ(a.Left(a.cols), 640);
  EXPECT_EQ(a.Top(a.rows), 480);
}

TEST(DepthWarp, StraighteningUndoesTheBendAndKeepsWhatIsNotMeasured) {
  DepthWarp warp;
  warp.cells = {40, 20, 2, 1};
  warp.pattern = Eigen::Vector2d(-0.01, 0.01);
  cv::Mat1f measured(20, 40, 2.0F * 0.99F);  // as the left cell measures 2 m
  measured(3, 3) = 0.0F;
  const cv::Mat1f straight = Straightened(measured, StraighteningBy(warp));
  EXPECT_NEAR(straight(0, 0), 2.0, 1e-6);  // constant beyond the outermost centres
  EXPECT_EQ(straight(3, 3), 0.0F);
  EXPECT_NEAR(straight(0, 39), 2.0 * 0.99 / 1.01, 1e-6);
  // Half-way between the centres p is 0.
  const cv::Mat1f pattern = StraighteningBy(warp).pattern;
  EXPECT_NEAR(pattern(0, 19) + pattern(0, 20), 0.0, 1e-6);
}

TEST(DepthWarp, ADisparityThatIsOffIsPutRightAtEveryDistance) {
  DepthWarp warp;
  warp.cells = {40, 20, 1, 1};
  warp.law = BendLaw::kDisparity;
  warp.pattern = Eigen::VectorXd::Constant(1, 0.004);
  const Straightening straightening = StraighteningBy(warp);
  for (const float z_m : {0.6F, 2.4F, 6.0F}) {
    // A matcher's depth is a constant over its disparity.
    const float off = 0.004F / static_cast<float>(kBendDistance_m);
    const cv::Mat1f measured(20, 40, 1.0F / (1.0F / z_m - off));
    EXPECT_NEAR(Straightened(measured, straightening)(7, 11), z_m, 1e-6 * z_m);
  }
}

// Between the outermost centres bilinear values of what is linear are that itself.
TEST(DepthWarp, StraighteningGoesEvenlyFromCellToCellAcrossAndDown) {
  DepthWarp warp;
  warp.cells = {40, 30, 4, 3};
  const auto linear = [](double u, double v) { return 0.01 + 2e-4 * u - 3e-4 * v; };
  warp.pattern.resize(warp.cells.count());
  for (int cell = 0; cell < warp.cells.count(); ++cell) {
    warp.pattern[cell] = linear(warp.cells.CentreU(cell % 4), warp.cells.CentreV(cell / 4));
  }
  const cv::Mat1f pattern = StraighteningBy(warp).pattern;
  ASSERT_EQ(pattern.size(), cv::Size(40, 30));
  for (int v = 0; v < 30; ++v) {
    for (int u = 0; u < 40; ++u) {
      const double expected =
          linear(std::clamp(u + 0.0, 4.5, 34.5), std::clamp(v + 0.0, 4.5, 24.5));
      EXPECT_NEAR(static_cast<double>(pattern(v, u)), expected, 1e-6) << u << " " << v;
    }
  }
}

}  // namespace
}  // namespace slam
