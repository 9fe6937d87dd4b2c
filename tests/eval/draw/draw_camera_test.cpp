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

// The numbers that the benchmark's page prints (Sturm et al., IROS 2012), to their last digit.
TEST(DrawCamera, KnowsTheCalibrationsOfTheTumBenchmark) {
  struct Printed {
    const char* name;
    std::array<double, 4> pixels;  // fx fy cx cy
    std::array<double, 5> lens;
  };
  for (const Printed& printed :
       {Printed{
            "tum1", {517.3, 516.5, 318.6, 255.3}, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}},
        Printed{
            "tum2", {520.9, 521.0, 325.1, 249.7}, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172}},
        Printed{"tum3", {535.4, 539.2, 320.1, 247.6}, {}}}) {
    const Camera c = ReadNamedCamera(printed.name);
    const std::array<double, 4> pixels = {c.fx, c.fy, c.cx, c.cy};
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(pixels[i], printed.pixels[i], 0.06) << printed.name;
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(c.distortion[i], printed.lens[i], 6e-5) << printed.name;
  }
}

}  // namespace
}  // namespace eval
