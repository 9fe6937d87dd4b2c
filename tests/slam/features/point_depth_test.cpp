#include "slam/features/point_depth.h"

#include <gtest/gtest.h>

namespace slam {
namespace {

TEST(PointDepth, IsTheMedianOfTheSquareAround) {
  cv::Mat1f depth_m(5, 5, 1.000f);
  depth_m(2, 2) = 1.004f;  // noise of the pixel itself
  EXPECT_FLOAT_EQ(static_cast<float>(DepthAt(depth_m, {2, 2}, {})), 1.0f);
}

TEST(PointDepth, IsNoneAcrossAStepBetweenSurfaces) {
  cv::Mat1f depth_m(5, 5, 1.0f);
  depth_m.col(3).setTo(1.05f);
  EXPECT_EQ(DepthAt(depth_m, {2, 2}, {}), 0.0);
  EXPECT_GT(DepthAt(depth_m, {1, 2}, {}), 0.0);  // the step is out of its square
}

TEST(PointDepth, FollowsASlantedSurface) {
  cv::Mat1f depth_m(5, 5);
  for (int v = 0; v < 5; ++v) {
    for (int u = 0; u < 5; ++u) depth_m(v, u) = 2.0f + 0.005f * static_cast<float>(u);
  }
  EXPECT_NEAR(DepthAt(depth_m, {2, 2}, {}), 2.01, 1e-6);
}

TEST(PointDepth, IsNoneWhereNothingWasMeasured) {
  cv::Mat1f depth_m(5, 5, 1.0f);
  depth_m(2, 2) = 0.0f;
  EXPECT_EQ(DepthAt(depth_m, {2, 2}, {}), 0.0);
  EXPECT_EQ(DepthAt(depth_m, {-1, 2}, {}), 0.0);
  EXPECT_EQ(DepthAt(depth_m, {2, 5}, {}), 0.0);
  EXPECT_EQ(DepthAt(cv::Mat1f(), {0, 0}, {}), 0.0);
}

TEST(PointDepth, IsReadAtTheImageBorder) {
  EXPECT_GT(DepthAt(cv::Mat1f(5, 5, 1.0f), {0, 0}, {}), 0.0);
  EXPECT_GT(DepthAt(cv::Mat1f(5, 5, 1.0f), {4, 4}, {}), 0.0);
}

TEST(PointDepth, IsNoneBeyondTheTrustedRange) {
  EXPECT_EQ(DepthAt(cv::Mat1f(5, 5, 0.1f), {2, 2}, {}), 0.0);
  EXPECT_EQ(DepthAt(cv::Mat1f(5, 5, 9.0f), {2, 2}, {}), 0.0);
}

}  // namespace
}  // namespace slam
