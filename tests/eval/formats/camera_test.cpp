#include "eval/formats/sequence/camera.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

namespace eval {
namespace {

// The lens of TUM's first camera, whose tangential terms are of unlike size and sign.
TEST(PixelOfPoint, IsWhereOpenCvSeesItThroughTheSameLens) {
  Camera camera;
  camera.width = 640, camera.height = 480;
  camera.fx = 517.3, camera.fy = 516.5, camera.cx = 318.6, camera.cy = 255.3;
  camera.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  std::vector<cv::Point3d> points;
  for (const double x : {-0.9, -0.3, 0.0, 0.4, 0.9}) {
    for (const double y : {-0.7, -0.2, 0.0, 0.5, 0.7}) points.emplace_back(x, y, 1.5);
  }
  std::vector<cv::Point2d> seen;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), K, camera.distortion, seen);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d pixel = PixelOf(camera, {points[i].x, points[i].y, points[i].z});
    EXPECT_NEAR(pixel.x(), seen[i].x, 1e-9) << points[i];
    EXPECT_NEAR(pixel.y(), seen[i].y, 1e-9) << points[i];
  }
}

}  // namespace
}  // namespace eval
