#include "slam/calibrate/depth_warp.h"

#include <gtest/gtest.h>

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
  const cv::Mat1f factors = StraighteningFactors(warp);
  cv::Mat1f measured(20, 40, 2.0F * 0.99F);  // as the left cell measures 2 m
  measured(3, 3) = 0.0F;
  const cv::Mat1f straight = Straightened(measured, factors);
  EXPECT_NEAR(straight(0, 0), 2.0, 1e-6);  // constant beyond the outermost centres
  EXPECT_EQ(straight(3, 3), 0.0F);
  EXPECT_NEAR(straight(0, 39), 2.0 * 0.99 / 1.01, 1e-6);
  // Half-way between the centres p is 0.
  EXPECT_NEAR(0.5 * (factors(0, 19) + factors(0, 20)), 1.0, 1e-5);
}

}  // namespace
}  // namespace slam
