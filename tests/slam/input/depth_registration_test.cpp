#include "slam/input/depth_registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace slam {
namespace {

Camera SmallView(int width, int height, double f) {
  Camera camera;
  camera.width = width, camera.height = height;
  camera.fx = camera.fy = f;
  camera.cx = (width - 1) / 2.0, camera.cy = (height - 1) / 2.0;
  return camera;
}

TEST(DepthRegistration, OfTheSameViewChangesNothing) {
  const Camera camera = SmallView(32, 24, 30);
  cv::Mat1f depth_m(24, 32);
  for (int i = 0; i < 24 * 32; ++i)
    depth_m(i / 32, i % 32) = i % 5 == 0 ? 0 : 0.5f + 0.01f * float(i);
  const cv::Mat1f laid = DepthRegistration(camera, camera, {}).Register(depth_m);
  EXPECT_EQ(cv::norm(laid, depth_m, cv::NORM_INF), 0);
}

TEST(DepthRegistration, OfAWallIsThatWallWithoutHolesInAFinerImage) {
  // A wall that both cameras see at a slant: n . x = 1 in the depth camera. Turned about the line
  // of sight, one way the columns of depth part in the colour image, the other way the rows.
  const Camera depth = SmallView(64, 48, 60), colour = SmallView(200, 150, 180);
  const Eigen::Vector3d n(0.2, -0.1, 0.6);
  cv::Mat1f depth_m(depth.height, depth.width);
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      depth_m(v, u) =
          static_cast<float>(1 / n.dot(depth.Backproject(Eigen::Vector2d(u, v), 1)));
    }
  }
  for (const double turn : {0.03, -0.03}) {
    const Pose T_cd{ExpSo3({0.01, -0.02, turn}), {0.015, 0.002, -0.001}};
    const cv::Mat1f laid = DepthRegistration(depth, colour, T_cd).Register(depth_m);
    const Eigen::Vector3d n_c = T_cd.R * n;
    const double d_c = 1 + n_c.dot(T_cd.t);
    for (int v = 20; v < 130; ++v) {
      for (int u = 20; u < 180; ++u) {
        const double z_m = d_c / n_c.dot(colour.Backproject(Eigen::Vector2d(u, v), 1));
        // A step of depth is a pixel of the coarser camera.
        EXPECT_NEAR(laid(v, u), z_m, 0.02 * z_m) << turn << ' ' << u << ' ' << v;
      }
    }
  }
}

TEST(DepthRegistration, TakesTheLensOfTheDepthCameraOut) {
  // A slanted wall through a lens that moves the corners by five pixels; colour has none.
  Camera depth = SmallView(64, 48, 60);
  const Camera colour = depth;
  depth.k1 = -0.3;
  const Eigen::Vector3d n(0.3, -0.1, 0.8);  // n . x = 1
  cv::Mat1f depth_m(depth.height, depth.width);
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      const Eigen::Vector3d ray =
          depth.Backproject(depth.Undistort(Eigen::Vector2d(u, v)), 1.0);
      depth_m(v, u) = static_cast<float>(1 / n.dot(ray));
    }
  }
  const cv::Mat1f laid = DepthRegistration(depth, colour, {}).Register(depth_m);
  for (int v = 0; v < colour.height; ++v) {
    for (int u = 0; u < colour.width; ++u) {
      const double z_m = 1 / n.dot(colour.Backproject(Eigen::Vector2d(u, v), 1));
      EXPECT_NEAR(laid(v, u), z_m, 0.02 * z_m) << u << ' ' << v;  // two pixels' steps
    }
  }
}

TEST(DepthRegistration, TellsTheDepthThatTheColourCameraSees) {
  // The colour camera stands a quarter of a metre behind the depth camera.
  const Camera camera = SmallView(64, 48, 60);
  Pose T_cd;
  T_cd.t = {0, 0, 0.25};
  const cv::Mat1f laid =
      DepthRegistration(camera, camera, T_cd).Register(cv::Mat1f(48, 64, 2.0f));
  EXPECT_EQ(laid(24, 32), 2.25f);
  EXPECT_EQ(laid(10, 50), 2.25f);
}

TEST(DepthRegistration, KeepsTheNearerOfTwoSurfaces) {
  // A strip at 0.5 m before a wall at 2 m; the colour camera is 10 cm to the right.
  const Camera camera = SmallView(64, 48, 60);
  cv::Mat1f depth_m(48, 64, 2.0f);
  depth_m.colRange(30, 40) = 0.5f;
  Pose T_cd;
  T_cd.t = {-0.1, 0, 0};
  const cv::Mat1f laid = DepthRegistration(camera, camera, T_cd).Register(depth_m);
  // The strip moves by 12 pixels, the wall by 3; where the strip hid the wall there is nothing.
  for (int u = 0; u < 59; ++u) {
    const float expected = u >= 18 && u < 28 ? 0.5f : u >= 28 && u < 37 ? 0.0f : 2.0f;
    EXPECT_EQ(laid(24, u), expected) << u;
  }
}

TEST(DepthRegistration, LaysNothingOfWhatIsBehindOrBesideTheColourCamera) {
  // A wall at half a metre, over 27 degrees to each side.
  const Camera camera = SmallView(65, 49, 60);
  const cv::Mat1f depth_m(49, 65, 0.5f);
  Pose beyond, turned_back, turned_aside;
  beyond.t = {0, 0, -1};
  turned_back.R = ExpSo3({0, M_PI, 0});
  turned_aside.R = ExpSo3({0, M_PI / 2, 0});
  for (const Pose& T_cd : {beyond, turned_back, turned_aside}) {
    const cv::Mat1f laid = DepthRegistration(camera, camera, T_cd).Register(depth_m);
    EXPECT_EQ(cv::countNonZero(laid), 0) << T_cd.R;
  }
}

TEST(DepthRegistration, LaysNothingWhereNothingWasMeasured) {
  // No depth is no point at the depth camera itself, a quarter of a metre before the other one.
  const Camera camera = SmallView(65, 49, 60);
  Pose T_cd;
  T_cd.t = {0, 0, 0.25};
  const cv::Mat1f laid =
      DepthRegistration(camera, camera, T_cd).Register(cv::Mat1f(49, 65, 0.0f));
  EXPECT_EQ(cv::countNonZero(laid), 0);
}

TEST(DepthRegistration, LetsNoSpeckAtTheLensHideTheWall) {
  // One pixel at 0.5 m before a wall at 2 m; the colour camera is 0.47 m ahead. At 3 cm from it
  // that pixel would cover (0.5 / 0.03) = 17 pixels each way.
  const Camera camera = SmallView(64, 48, 60);
  cv::Mat1f depth_m(48, 64, 2.0f);
  depth_m(24, 32) = 0.5f;
  Pose T_cd;
  T_cd.t = {0, 0, -0.47};
  const cv::Mat1f laid = DepthRegistration(camera, camera, T_cd).Register(depth_m);
  // From its corner, the middle of the image, to the right and down; the wall's gap is 2 pixels.
  for (int step = 3; step < 16; ++step)
    EXPECT_FLOAT_EQ(laid(23 + step, 31 + step), 1.53f) << step;
}

}  // namespace
}  // namespace slam
