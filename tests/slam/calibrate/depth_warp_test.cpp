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

}  // namespace
}  // namespace slam
