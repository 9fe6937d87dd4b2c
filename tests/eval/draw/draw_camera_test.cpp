#include "eval/draw/draw_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace eval {
namespace {

// A floor 1 m below the camera, from 5 m before it to 3 m behind: what is left of it is convex.
TEST(ProjectOutline, OfAFloorThatReachesBehindTheCameraDoesNotCrossItself) {
  Camera camera;
  camera.width = 640, camera.height = 480;
  camera.fx = camera.fy = 500, camera.cx = 319.5, camera.cy = 239.5;
  const std::vector<Eigen::Vector3d> floor_c{{-2, 1, 5}, {2, 1, 5}, {2, 1, -3}, {-2, 1, -3}};
  for (std::size_t first = 0; first < 4; ++first) {
    std::vector<Eigen::Vector3d> turned = floor_c;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first),
                turned.end());
    std::vector<cv::Point2f> outline, hull;
    for (const cv::Point2d& p : ProjectOutline(camera, turned)) outline.emplace_back(p);
    ASSERT_EQ(outline.size(), 4u);
    cv::convexHull(outline, hull);
    EXPECT_NEAR(cv::contourArea(outline), cv::contourArea(hull), 1e-3 * cv::contourArea(hull));
  }
}

}  // namespace
}  // namespace eval
