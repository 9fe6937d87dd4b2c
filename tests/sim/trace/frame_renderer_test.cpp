#include "sim/trace/frame_renderer.h"
#include "sim/shapes/planes.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

/// z of a plane at a pixel is two divisions and a few products: 1e-12 leaves a factor of 1000.
constexpr double kDoubleRoundOff = 1e-12;

TEST(RenderedDepth, OfASquareBoardIsItsDistanceInEveryPixel) {
  const FrameRenderer renderer(OneBoard(1.3), SmallCamera());
  const Rendering rendering = renderer.Render(LookAlongY());
  double low, high;
  cv::minMaxLoc(rendering.depth_m, &low, &high);
  EXPECT_NEAR(low, 1.3, kDoubleRoundOff);
  EXPECT_NEAR(high, 1.3, kDoubleRoundOff);
}

TEST(RenderedDepth, IsPlanarNotAlongTheRay) {
  const Camera camera = SmallCamera();
  const FrameRenderer renderer(OneBoard(2.0), camera);
  const Rendering rendering = renderer.Render(LookAlongY());
  EXPECT_NEAR(rendering.depth_m(0, 0), 2.0, kDoubleRoundOff);
  EXPECT_GT(2.0 * camera.Ray(0, 0).norm(), 2.3);  // what a ray length would say
}

TEST(RenderedIds, NameTheFrontFaceAndNothingBeside) {
  Scene scene = OneBoard(1.0, 0.2);
  const FrameRenderer renderer(scene, SmallCamera());
  const Rendering rendering = renderer.Render(LookAlongY());
  const std::vector<ScenePlane> planes = ScenePlanes(scene);
  const int seen = rendering.plane_id(60, 80);
  ASSERT_GT(seen, 0);
  EXPECT_NEAR(planes[static_cast<std::size_t>(seen) - 1].n_w.y(), -1.0, kDoubleRoundOff);
  EXPECT_EQ(rendering.object_id(60, 80), 1);
  EXPECT_EQ(rendering.plane_id(0, 0), 0);
  EXPECT_EQ(rendering.object_id(0, 0), 0);
  EXPECT_EQ(rendering.depth_m(0, 0), 0.0);
}

TEST(RenderedIds, GiveAToyAnObjectButNoPlane) {
  const FrameRenderer renderer(SmallDesk(), SmallCamera());
  const Rendering rendering = renderer.Render(SmallArc(1)[0].T_wc);
  int toy_pixels = 0;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      if (rendering.object_id(v, u) != 7) continue;
      ++toy_pixels;
      EXPECT_EQ(rendering.plane_id(v, u), 0);
      EXPECT_GT(rendering.depth_m(v, u), 0.0);
    }
  }
  EXPECT_GT(toy_pixels, 50);
}

TEST(RenderedLight, FallsLessBrightInTheShadowOfABox) {
  Scene scene;
  scene.sun.direction_w = {1, 0, -1};
  scene.objects = {
      BoxObject(1, "floor", Role::kStructure, {0, 0, -0.05}, {4, 4, 0.1}, Print::kPlain),
      BoxObject(2, "box", Role::kRegular, {0, 0, 0.1}, {0.2, 0.2, 0.2}, Print::kPlain)};
  const Camera camera = SmallCamera();
  const FrameRenderer renderer(scene, camera);
  const Pose T_wc = LookAt({0, -0.01, 2.0}, {0, 0, 0});
  const Rendering rendering = renderer.Render(T_wc);
  const auto brightness = [&](const Eigen::Vector3d& x_w) {
    const Eigen::Vector2d pixel = camera.Project(Inverse(T_wc) * x_w);
    return rendering.radiance(static_cast<int>(std::lround(pixel.y())),
                              static_cast<int>(std::lround(pixel.x())))[1];
  };
  const float shadow = brightness({0.2, 0, 0}), sunny = brightness({-0.3, 0, 0});
  EXPECT_LT(shadow, 0.7F * sunny);
  EXPECT_GT(shadow, 0.1F * sunny);  // the ambient light is left
}

TEST(UnoccludedPixels, CountWhatTheObjectWouldShowAlone) {
  Scene both = OneBoard(2.0, 0.6);
  both.objects.push_back(BoxObject(2, "box", Role::kRegular, {0.1, 1.0, 0}, {0.2, 0.1, 0.2}));
  Scene alone = both;
  alone.objects.pop_back();
  const FrameRenderer renderer(both, SmallCamera());
  const Rendering rendering = renderer.Render(LookAlongY());
  const Rendering bare = FrameRenderer(alone, SmallCamera()).Render(LookAlongY());
  const int expected = cv::countNonZero(bare.object_id == 1);
  EXPECT_LT(cv::countNonZero(rendering.object_id == 1), expected);
  EXPECT_EQ(
      renderer.UnoccludedPixels(0, LookAlongY(), cv::Rect(0, 0, 160, 120), rendering.object_id),
      expected);
}

TEST(FrameRenderer, RefusesAnObjectIdThatDoesNotFitTheImage) {
  Scene scene = OneBoard(1.0);
  scene.objects[0].id = 65536;
  EXPECT_THROW(FrameRenderer(scene, SmallCamera()), std::invalid_argument);
}

}  // namespace
}  // namespace sim
