#include "slam/features/point_depth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/geometry/plane.h"

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

TEST(PointDepth, IsNoneWhereAnyPixelOfTheSquareIsOfAnotherSurface) {
  for (int v = 0; v < 5; ++v) {
    for (int u = 0; u < 5; ++u) {
      cv::Mat1f depth_m(5, 5, 1.0f);
      depth_m(v, u) = 1.05f;
      const bool in_square = std::abs(u - 2) <= 1 && std::abs(v - 2) <= 1;
      EXPECT_EQ(DepthAt(depth_m, {2, 2}, {}) == 0.0, in_square) << u << " " << v;
    }
  }
}

TEST(PointDepth, FollowsASlantedSurface) {
  cv::Mat1f depth_m(5, 5);
  for (int v = 0; v < 5; ++v) {
    for (int u = 0; u < 5; ++u) depth_m(v, u) = 2.0f + 0.005f * static_cast<float>(u);
  }
  EXPECT_NEAR(DepthAt(depth_m, {2, 2}, {}), 2.01, 1e-6);
}

TEST(PointDepth, AllowsForNoiseThatDoesNotShrinkWithTheDepth) {
  const auto across_m = [](float near_m, float step_m, const PointDepthConfig& config = {}) {
    cv::Mat1f depth_m(5, 5, near_m);
    depth_m.col(3).setTo(near_m + step_m);
    return DepthAt(depth_m, {2, 2}, config);
  };
  // A hand's breadth away 2 % are 5 mm, but 10 mm are allowed; far away 2 % are more.
  EXPECT_FLOAT_EQ(static_cast<float>(across_m(0.25f, 0.009f)), 0.25f);
  EXPECT_EQ(across_m(0.25f, 0.011f), 0.0);
  EXPECT_FLOAT_EQ(static_cast<float>(across_m(2.0f, 0.035f)), 2.0f);
  EXPECT_EQ(across_m(2.0f, 0.045f), 0.0);
  PointDepthConfig noisy;
  noisy.max_step_m = 0.06;
  EXPECT_FLOAT_EQ(static_cast<float>(across_m(1.0f, 0.05f, noisy)), 1.0f);
  EXPECT_EQ(across_m(1.0f, 0.07f, noisy), 0.0);
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

/// Depth of a plane as a pinhole camera sees it.
cv::Mat1f DepthOf(const Plane& pi_c, const Camera& camera) {
  cv::Mat1f depth_m(camera.height, camera.width);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.Backproject(Eigen::Vector2d(u, v), 1.0);
      depth_m(v, u) = static_cast<float>(-pi_c.d / pi_c.n.dot(ray));
    }
  }
  return depth_m;
}

TEST(DepthFrom, IsWhatTheCameraOfNowSeesOfASlantedPlane) {
  // Half a second's hand: 15 mm and 1.5 degrees between the colour image and the depth image.
  const Camera camera = TumCamera("tum3");
  const Pose T_dc{ExpSo3({0.01, -0.02, 0.015}), {0.004, -0.006, 0.013}};
  const Plane pi_c{Eigen::Vector3d(0.3, -0.5, -0.8).normalized(), 1.2};
  const cv::Mat1f here_m = DepthOf(pi_c, camera),
                  there_m = DepthOf(Transform(T_dc, pi_c), camera);
  for (const Eigen::Vector2d& u_px : {Eigen::Vector2d(100, 80), {320, 240}, {570, 400}}) {
    const double seen_m = DepthFrom(T_dc, there_m, camera, u_px, {});
    const double truth_m = DepthAt(here_m, u_px, {});
    // The depth image is read at whole pixels: half of one, 0.5 mm, on this plane.
    EXPECT_NEAR(seen_m, truth_m, 2e-3);
    EXPECT_GT(std::abs(DepthAt(there_m, u_px, {}) - truth_m), 8e-3);
  }
}

TEST(DepthFrom, IsThatOfThePixelWhereTheCameraStands) {
  Camera camera = TumCamera("tum1");  // with a lens
  const cv::Mat1f depth_m = DepthOf({-Eigen::Vector3d::UnitZ(), 1.5}, camera);
  EXPECT_NEAR(DepthFrom({}, depth_m, camera, {200, 300}, {}), 1.5, 1e-6);
}

// Depth lies on the image as recorded: at the ideal pixel it is another thing's, or none.
TEST(DepthFrom, IsReadWhereTheLensShowsThePoint) {
  const Camera camera = TumCamera("tum1");
  const Eigen::Vector2d ideal(60, 50);
  const Eigen::Vector2d shown = camera.ProjectDistorted(camera.Backproject(ideal, 1.0));
  ASSERT_GT((shown - ideal).cwiseAbs().maxCoeff(), 2.0);
  cv::Mat1f depth_m(camera.height, camera.width, 0.0f);
  const cv::Point at(static_cast<int>(std::lround(shown.x())),
                     static_cast<int>(std::lround(shown.y())));
  depth_m(cv::Rect(at.x - 1, at.y - 1, 3, 3)).setTo(1.5f);
  EXPECT_NEAR(DepthFrom({}, depth_m, camera, ideal, {}), 1.5, 1e-6);
  EXPECT_EQ(DepthFrom({}, depth_m, camera, shown, {}), 0.0);
}

TEST(DepthFrom, IsNoneOutsideOfTheDepthImage) {
  const Camera camera = TumCamera("tum3");
  const cv::Mat1f depth_m = DepthOf({-Eigen::Vector3d::UnitZ(), 1.5}, camera);
  const Pose T_dc{ExpSo3({0, 0.1, 0}), Eigen::Vector3d::Zero()};  // 52 px
  EXPECT_EQ(DepthFrom(T_dc, depth_m, camera, {620, 240}, {}), 0.0);
  EXPECT_GT(DepthFrom(T_dc, depth_m, camera, {20, 240}, {}), 0.0);
}

}  // namespace
}  // namespace slam
