#include "sim/trace/lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "sim/trace/frame_renderer.h"
#include "tests/sim/support/sim_worlds.h"

// Light on a floor by pencil and paper. A light's part of a picture is what it adds to one by
// ambient light alone, so that the floor's own colour drops out.
namespace sim {
namespace {

constexpr double kOnFloor = 0.8 + 0.12;  ///< of ambient light 1, on a level surface
constexpr double kFloatRoundOff = 2e-6;  ///< of light about 1 that is a ratio of floats

Scene Floor() {
  Scene scene;
  scene.sun.intensity = 0;
  scene.sun.direction_w = {0, 0, 1};  // behind the floor: it draws no shadow's edge
  scene.sun.ambient = 1;
  scene.objects = {
      BoxObject(1, "floor", Role::kStructure, {0, 0, -0.05}, {8, 8, 0.1}, Print::kPlain)};
  return scene;
}

Light Lamp(const Eigen::Vector3d& at_w, double intensity) {
  Light light;
  light.center_w = at_w;
  light.intensity = intensity;
  return light;
}

/// Level, two metres over the floor, shines down: 0.8 m along x, 0.4 m along y.
Light Panel(int samples_per_side) {
  Light light = Lamp({0, 0, 2}, 1.5);
  light.kind = LightKind::kArea;
  light.half_a_w = {0.4, 0, 0};
  light.half_b_w = {0, -0.2, 0};
  light.samples_per_side = samples_per_side;
  return light;
}

struct LitPixel {
  Eigen::Vector3d x_w;
  double light;  ///< green
};

/// What the lights of the scene give to the pixels of the floor.
std::vector<LitPixel> LightOnFloor(const Scene& scene, const Pose& T_wc, const Camera& camera,
                                   int channel = 1) {
  Scene dark = scene;
  dark.lights.clear();
  const Rendering lit = FrameRenderer(scene, camera).Render(T_wc);
  const Rendering unlit = FrameRenderer(dark, camera).Render(T_wc);
  std::vector<LitPixel> pixels;
  for (int v = 1; v + 1 < camera.height; ++v) {
    for (int u = 1; u + 1 < camera.width; ++u) {
      if (cv::countNonZero(lit.object_id(cv::Rect(u - 1, v - 1, 3, 3)) != 1) > 0) continue;
      const double ratio = static_cast<double>(lit.radiance(v, u)[channel]) /
                           static_cast<double>(unlit.radiance(v, u)[channel]);
      pixels.push_back({T_wc * (lit.depth_m(v, u) * camera.Ray(u, v)), (ratio - 1) * kOnFloor});
    }
  }
  return pixels;
}

/// Integral of cos cos / r^2 over a rectangle at height h, whose corner is straight above the
/// spot: pi times the form factor (any book on radiative heat transfer).
double FromCorner(double a_m, double b_m, double h) {
  const double a = a_m / h, b = b_m / h, ra = std::hypot(1, a), rb = std::hypot(1, b);
  return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / 2;
}

/// Light of the part low_x <= x <= high_x of the panel on the floor at x_w.
double FromPanel(const Light& panel, double low_x, double high_x, const Eigen::Vector3d& x_w) {
  const double h = panel.center_w.z(), half_y = std::abs(panel.half_b_w.y());
  double sum = 0;
  for (const double y : {half_y - x_w.y(), half_y + x_w.y()}) {
    sum += FromCorner(high_x - x_w.x(), y, h) - FromCorner(low_x - x_w.x(), y, h);
  }
  return panel.intensity * sum / (4 * panel.half_a_w.norm() * panel.half_b_w.norm());
}

TEST(ALamp, GivesItsIntensityOverTheSquareOfTheDistanceTimesTheCosine) {
  Scene scene = Floor();
  scene.lights = {Lamp({0.1, 0.2, 0.8}, 0.5)};
  scene.lights[0].colour = {1, 0.5, 0.25};
  const Pose T_wc = LookAt({0, -1, 1.5}, {0, 0, 0});
  for (const int channel : {0, 1, 2}) {
    const auto pixels = LightOnFloor(scene, T_wc, SmallCamera(), channel);
    ASSERT_GT(pixels.size(), 15000u);
    for (const auto& [x_w, light] : pixels) {
      const double r = (scene.lights[0].center_w - x_w).norm();
      ASSERT_NEAR(light, std::pow(0.5, channel) * 0.5 / (r * r) * (0.8 / r), kFloatRoundOff);
    }
  }
}

TEST(ALamp, ThrowsTheShadowOfABoxBySimilarTriangles) {
  Scene scene = Floor();
  // Its upper edges are half a metre up, a quarter of the way to the lamp.
  scene.objects.push_back(
      BoxObject(2, "box", Role::kRegular, {0, 0, 0.45}, {0.2, 0.3, 0.1}, Print::kPlain));
  scene.objects.push_back(
      BoxObject(3, "box", Role::kRegular, {0, 0, 3}, {4, 4, 0.1}, Print::kPlain));
  scene.lights = {Lamp({0, 0, 2}, 2)};
  constexpr double kEdge_m = 0.006;  // two pixels
  int inside = 0, outside = 0;
  for (const auto& [x_w, light] :
       LightOnFloor(scene, LookAt({1.0, -1.0, 1.2}, {0, 0, 0}), Camera{})) {
    const double beyond =
        std::max(std::abs(x_w.x()) - 0.1 / 0.75, std::abs(x_w.y()) - 0.15 / 0.75);
    if (std::abs(beyond) < kEdge_m) continue;
    ++(beyond < 0 ? inside : outside);
    const double r = (scene.lights[0].center_w - x_w).norm();
    ASSERT_NEAR(light, beyond < 0 ? 0.0 : 4 / (r * r * r), kFloatRoundOff) << x_w.transpose();
  }
  EXPECT_GT(inside, 3000);
  EXPECT_GT(outside, 50000);
}

TEST(ALamp, HasAShadowWhoseEdgeIsSmoothInThePicture) {
  Scene scene = Floor();
  scene.objects.push_back(
      BoxObject(2, "box", Role::kRegular, {0, 0, 0.45}, {0.2, 0.3, 0.1}, Print::kPlain));
  scene.lights = {Lamp({0, 0, 2}, 2)};
  int between = 0;
  for (const auto& [x_w, light] :
       LightOnFloor(scene, LookAt({1.0, -1.0, 1.2}, {0, 0, 0}), Camera{})) {
    const double r = (scene.lights[0].center_w - x_w).norm(), full = 4 / (r * r * r);
    between += light > 0.2 * full && light < 0.8 * full;
  }
  EXPECT_GT(between, 100);  // its outline is hundreds of pixels long
}

TEST(AnAreaLight, GivesWhatTheFormFactorOfItsRectangleSays) {
  Scene scene = Floor();
  scene.lights = {Panel(4)};
  const auto pixels = LightOnFloor(scene, LookAt({0, -2, 1.5}, {0, 0, 0}), SmallCamera());
  ASSERT_GT(pixels.size(), 10000u);
  for (const auto& [x_w, light] : pixels) {
    const double expected = FromPanel(scene.lights[0], -0.4, 0.4, x_w);
    ASSERT_NEAR(light, expected, 0.002 * expected) << x_w.transpose();
  }
}

// A world that moves is traced in a frame of its own, turned against that of the lights.
TEST(AnAreaLight, GivesTheSameInAFrameThatIsTurned) {
  const Pose T_sw{Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, 2, 0.5).normalized()).matrix(),
                  {0.3, -1, 2}};
  Spots there, here;
  for (std::size_t i = 0; i < RayPacket::kLanes; ++i) {
    there.used[i] = true;
    there.x_w[i] = {0.2 * static_cast<double>(i) - 0.7, 0.3, 0.1};
    there.n_w[i] = there.shading_n_w[i] = Eigen::Vector3d::UnitZ();
  }
  here = there;
  for (std::size_t i = 0; i < RayPacket::kLanes; ++i) {
    here.x_w[i] = Inverse(T_sw) * there.x_w[i];
    here.n_w[i] = here.shading_n_w[i] = T_sw.R.transpose() * there.n_w[i];
  }
  const auto open = [](const RayPacket&) { return std::array<bool, RayPacket::kLanes>{}; };
  LightPoints level, turned;
  level.Start({Panel(2)}, Pose{});
  turned.Start({Panel(2)}, T_sw);
  const LightAtSpots expected = level.At(there, open), found = turned.At(here, open);
  for (std::size_t i = 0; i < RayPacket::kLanes; ++i) {
    EXPECT_GT(expected.light[i][1], 0.1f);
    EXPECT_NEAR(found.light[i][1], expected.light[i][1], kFloatRoundOff);
  }
}

TEST(AnAreaLight, ThrowsAPenumbraAsWideAsSimilarTrianglesSay) {
  // A blade half way up hides the light from x < 0: the penumbra is as wide as the light.
  Scene scene = Floor();
  scene.objects.push_back(
      BoxObject(2, "box", Role::kRegular, {-2, 0, 0.9995}, {4, 8, 0.001}, Print::kPlain));
  scene.lights = {Panel(8)};
  const Light& panel = scene.lights[0];
  constexpr double kSample = 1.2 / 64;  // the share of a sample, more where it is square on
  constexpr double kBlade_m = 0.002;
  int none = 0, half = 0, full = 0;
  for (const auto& [x_w, light] :
       LightOnFloor(scene, LookAt({0, -1.5, 0.7}, {0, 0, 0}), SmallCamera())) {
    const double whole = FromPanel(panel, -0.4, 0.4, x_w);
    if (x_w.x() < -0.4 - kBlade_m) {
      ++none;
      ASSERT_EQ(light, 0.0) << x_w.transpose();
    } else if (x_w.x() > 0.4 + kBlade_m) {
      ++full;
      ASSERT_NEAR(light, whole, 0.002 * whole) << x_w.transpose();
    } else {
      half += std::abs(x_w.x()) < 0.01;
      const double low = std::clamp(-x_w.x(), -0.4, 0.4);
      ASSERT_NEAR(light, FromPanel(panel, low, 0.4, x_w), kSample * whole) << x_w.transpose();
    }
  }
  EXPECT_GT(none, 1000);
  EXPECT_GT(half, 50);
  EXPECT_GT(full, 1000);
}

TEST(AnAreaLight, HidesItsSamplesOneByOneBehindAnEdgeAlongASide) {
  Scene scene = Floor();
  scene.objects.push_back(
      BoxObject(2, "box", Role::kRegular, {-2, 0, 0.9995}, {4, 8, 0.001}, Print::kPlain));
  scene.lights = {Panel(4)};
  std::vector<int> steps(17);
  for (const auto& [x_w, light] :
       LightOnFloor(scene, LookAt({0, -1.5, 0.7}, {0, 0, 0}), SmallCamera())) {
    const double share = 16 * light / FromPanel(scene.lights[0], -0.4, 0.4, x_w);
    ++steps[static_cast<std::size_t>(std::clamp(std::lround(share), 0L, 16L))];
  }
  for (const int pixels : steps) EXPECT_GT(pixels, 20);
}

TEST(AnAreaLight, IsDarkBehind) {
  Scene scene = Floor();
  scene.lights = {Panel(4)};
  scene.lights[0].half_b_w *= -1;  // its front is up
  const auto pixels = LightOnFloor(scene, LookAt({0, -2, 1.5}, {0, 0, 0}), SmallCamera());
  ASSERT_FALSE(pixels.empty());
  for (const auto& [x_w, light] : pixels) ASSERT_EQ(light, 0.0);
}

TEST(AnAreaLight, MayHangOnACeiling) {
  Scene scene = Floor();
  scene.lights = {Panel(4)};
  const Pose T_wc = LookAt({0, -2, 1.5}, {0, 0, 0});
  const auto free = LightOnFloor(scene, T_wc, SmallCamera());
  scene.objects.push_back(
      BoxObject(2, "wall", Role::kStructure, {0, 0, 2.05}, {4, 4, 0.1}, Print::kPlain));
  const auto hung = LightOnFloor(scene, T_wc, SmallCamera());
  ASSERT_EQ(hung.size(), free.size());
  for (std::size_t i = 0; i < hung.size(); ++i) ASSERT_EQ(hung[i].light, free[i].light);
}

TEST(LampsAndAreaLights, AddUp) {
  Scene scene = Floor();
  const std::vector<Light> all = {Lamp({0.1, 0.2, 0.8}, 0.5), Panel(3),
                                  Lamp({-0.6, 0, 1}, 0.7)};
  const Pose T_wc = LookAt({0, -1, 1.5}, {0, 0, 0});
  scene.lights = all;
  const auto together = LightOnFloor(scene, T_wc, SmallCamera());
  ASSERT_FALSE(together.empty());
  std::vector<double> sum(together.size(), 0.0);
  for (const Light& light : all) {
    scene.lights = {light};
    const auto alone = LightOnFloor(scene, T_wc, SmallCamera());
    ASSERT_EQ(alone.size(), sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += alone[i].light;
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    ASSERT_NEAR(together[i].light, sum[i], 4 * kFloatRoundOff);
}

TEST(LightPoints, GiveNothingToASurfaceThatTurnsItsBack) {
  LightPoints lights;
  lights.Start({Lamp({0, 0, 1}, 1), Panel(4)}, Pose{});
  Spots spots;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  for (std::size_t i = 0; i < 3; ++i) {
    spots.used[i] = true;
    spots.x_w[i] = {0.3, 0, 0};
    spots.n_w[i] = i == 1 ? Eigen::Vector3d(-up) : up;
    spots.shading_n_w[i] = i == 2 ? Eigen::Vector3d(-up) : up;
  }
  const LightAtSpots found =
      lights.At(spots, [](const RayPacket&) { return std::array<bool, 8>{}; });
  EXPECT_GT(found.light[0][0], 0.5F);
  EXPECT_EQ(found.seen[0], 3u);
  for (const std::size_t i : {1u, 2u, 3u}) {
    EXPECT_EQ(found.light[i], cv::Vec3f(0, 0, 0)) << i;
    EXPECT_EQ(found.seen[i], 0u) << i;
  }
}

TEST(LightPoints, NeverShineBrighterThanFromACentimetre) {
  LightPoints lights;
  lights.Start({Lamp({0, 0, 1e-9}, 1)}, Pose{});
  Spots spots;
  spots.used[0] = true;
  spots.x_w[0] = Eigen::Vector3d::Zero();
  spots.n_w[0] = spots.shading_n_w[0] = Eigen::Vector3d::UnitZ();
  const LightAtSpots found =
      lights.At(spots, [](const RayPacket&) { return std::array<bool, 8>{}; });
  EXPECT_NEAR(found.light[0][0], 1e4F, 1.0F);
}

TEST(WhatMoves, ThrowsAndTakesTheShadowsOfLamps) {
  Scene moving = Floor();
  Object cube =
      BoxObject(2, "box", Role::kUnstructured, {-0.5, 0, 0.4}, {0.2, 0.2, 0.2}, Print::kPlain);
  cube.way = {{0, {-0.5, 0, 0.4}, 0}, {1, {0.5, 0.1, 0.5}, 90}};
  cube.center_w = cube.way[0].center_w;
  moving.objects.push_back(cube);
  moving.lights = {Lamp({0.3, 0.2, 1.5}, 1.2), Panel(3)};
  Scene frozen = moving;
  frozen.objects[1].way.clear();
  frozen.objects[1].center_w = {0, 0.05, 0.45};
  frozen.objects[1].q_wo = Eigen::AngleAxisd(std::atan(1.0), Eigen::Vector3d::UnitZ());
  const Pose T_wc = LookAt({0.2, -1.6, 1.0}, {0, 0, 0.2});
  RenderOptions options;
  options.time_s = 0.5;
  const cv::Mat3f a = FrameRenderer(moving, SmallCamera()).Render(T_wc, options).radiance;
  const cv::Mat3f b = FrameRenderer(frozen, SmallCamera()).Render(T_wc).radiance;
  int differ = 0;  // at outlines, which are mixed in another way
  for (int v = 0; v < a.rows; ++v) {
    for (int u = 0; u < a.cols; ++u) differ += cv::norm(a(v, u) - b(v, u)) > 1e-3;
  }
  EXPECT_LT(differ, 100);
}

}  // namespace
}  // namespace sim
