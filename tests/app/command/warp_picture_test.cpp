#include "app/calibrate/warp_picture.h"

#include <gtest/gtest.h>

namespace app {
namespace {

// The title says: measured too far (red) or too near.
TEST(WarpPicture, IsRedWhereDepthIsTooFarAndBlueWhereItIsTooNear) {
  slam::DepthWarp warp;
  warp.cells = {640, 480, 2, 1};
  warp.pattern = Eigen::Vector2d(0.004, -0.004);
  warp.sigma = Eigen::Vector2d(0.001, 0.001);
  const cv::Mat3b page = DrawWarp(warp);
  const cv::Vec3b left = page(200, 160), right = page(200, 480);  // of the pattern's panel
  EXPECT_EQ(left, cv::Vec3b(0, 0, 255));
  EXPECT_EQ(right, cv::Vec3b(255, 0, 0));
}

TEST(WarpPicture, HasTheFirstRowOfCellsAtTheTop) {
  slam::DepthWarp warp;
  warp.cells = {640, 480, 1, 2};
  warp.pattern = Eigen::Vector2d(0.004, -0.004);
  warp.sigma = Eigen::Vector2d(0.001, 0.001);
  const cv::Mat3b page = DrawWarp(warp);
  EXPECT_EQ(page(150, 320), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(page(400, 320), cv::Vec3b(255, 0, 0));
}

}  // namespace
}  // namespace app
