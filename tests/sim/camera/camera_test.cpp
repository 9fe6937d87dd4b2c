#include "sim/camera/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>

#include "io/input_error.h"

namespace sim {
namespace {

constexpr double kRoundOff_px = 1e-9;

TEST(ResizedCamera, KeepsTheRaysOfTheImageBorders) {
  const Camera camera;
  const Eigen::Vector3d low = camera.Ray(-0.5, -0.5), high = camera.Ray(639.5, 479.5);
  for (const auto& [width, height] : {std::pair(160, 120), {640, 360}, {320, 640}}) {
    const Camera resized = Resize(camera, width, height);
    EXPECT_NEAR((resized.Ray(-0.5, -0.5) - low).norm(), 0, kRoundOff_px);
    EXPECT_NEAR((resized.Ray(width - 0.5, height - 0.5) - high).norm(), 0, kRoundOff_px);
  }
}

TEST(ResizedCamera, ProjectsItsOwnRaysBack) {
  const Camera camera = Resize(Camera{}, 320, 200);
  EXPECT_NEAR((camera.Project(3.0 * camera.Ray(17, 41)) - Eigen::Vector2d(17, 41)).norm(), 0,
              kRoundOff_px);
}

TEST(ResizedCamera, RefusesAnImageTooSmallToHoldAnything) {
  EXPECT_THROW(Resize(Camera{}, 15, 120), std::invalid_argument);
  EXPECT_THROW(Resize(Camera{}, 160, -1), std::invalid_argument);
}

TEST(CameraYaml, PrintsEveryDigit) {
  Camera camera;
  camera.fx = 1.0 / 3.0;
  const std::string text = CameraYaml(camera);
  const std::size_t at = text.find("fx: ") + 4;
  EXPECT_EQ(std::stod(text.substr(at)), 1.0 / 3.0);
  EXPECT_NE(text.find("model: pinhole\nwidth: 640\nheight: 480\n"), std::string::npos);
}

/// The first Kinect of the TUM benchmark, as calibrated there.
constexpr Lens kRecordedLens{
    .k1 = 0.2624, .k2 = -0.9531, .p1 = -0.0054, .p2 = 0.0026, .k3 = 1.1633};

/// What OpenCV makes of a point.
cv::Point2d ProjectedByOpenCv(const Camera& camera, const Eigen::Vector3d& x_c) {
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const Lens& lens = camera.lens;
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(std::vector<cv::Point3d>{{x_c.x(), x_c.y(), x_c.z()}}, cv::Vec3d(),
                    cv::Vec3d(), K,
                    cv::Vec<double, 5>(lens.k1, lens.k2, lens.p1, lens.p2, lens.k3), pixels);
  return pixels[0];
}

TEST(LensDistortion, AgreesWithOpenCvAllOverTheImage) {
  const Camera camera = WithLens(Camera{}, kRecordedLens);
  for (int v = 0; v < camera.height; v += 13) {
    for (int u = 0; u < camera.width; u += 17) {
      const Eigen::Vector3d x_c = 1.7 * camera.Ray(u, v);
      const cv::Point2d pixel = ProjectedByOpenCv(camera, x_c);
      EXPECT_NEAR(pixel.x, u, kRoundOff_px);
      EXPECT_NEAR(pixel.y, v, kRoundOff_px);
      EXPECT_NEAR((camera.Project(x_c) - Eigen::Vector2d(u, v)).norm(), 0, kRoundOff_px);
    }
  }
}

TEST(LensDistortion, DoesNotFoldWhatLiesFarOutsideIntoTheImage) {
  const Camera camera = WithLens(Camera{}, {.k1 = -0.3, .k2 = 0.05});
  double last = 0;
  for (double x = 0.1; x < 20; x *= 1.1) {
    const double u = camera.Project({x, 0, 1}).x();
    EXPECT_GT(u, last);
    last = u;
  }
}

TEST(LensDistortion, IsRefusedWhereItFoldsTheImage) {
  EXPECT_THROW(WithLens(Camera{}, {.k1 = -2.0}), io::InputError);
  EXPECT_THROW(WithLens(Camera{}, {.k1 = std::nan("")}), io::InputError);
}

TEST(LensDistortion, StandsInCameraYamlOnlyWhenThereIsOne) {
  EXPECT_EQ(CameraYaml(Camera{}).find("k1"), std::string::npos);
  EXPECT_NE(CameraYaml(WithLens(Camera{}, kRecordedLens)).find("k2: -0.9531\np1: -0.0054\n"),
            std::string::npos);
}

TEST(CameraOf, IsTheCameraThatTheSceneNames) {
  Capture capture;
  capture.width = 320;
  capture.height = 200;
  capture.fx = 260;
  capture.fy = 261;
  capture.cx = 150;
  capture.cy = 99;
  capture.fps = 15;
  capture.distortion = {0.05, -0.02, 0.001, 0.002, 0.003};
  const Camera camera = CameraOf(capture);
  EXPECT_EQ(camera.width, 320);
  EXPECT_EQ(camera.height, 200);
  EXPECT_EQ(camera.fx, 260);
  EXPECT_EQ(camera.fy, 261);
  EXPECT_EQ(camera.cx, 150);
  EXPECT_EQ(camera.cy, 99);
  EXPECT_EQ(camera.fps, 15);
  EXPECT_EQ(camera.lens.k1, 0.05);
  EXPECT_EQ(camera.lens.k2, -0.02);
  EXPECT_EQ(camera.lens.p1, 0.001);
  EXPECT_EQ(camera.lens.p2, 0.002);
  EXPECT_EQ(camera.lens.k3, 0.003);
  // A scene that names none is recorded as one without the block always was.
  EXPECT_EQ(CameraYaml(CameraOf(Capture{})), CameraYaml(Camera{}));
}

}  // namespace
}  // namespace sim
