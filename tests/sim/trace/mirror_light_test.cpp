#include "sim/trace/mirror_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "sim/trace/frame_renderer.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

const Pose kAbove = LookAt({0, -1, 1}, {0, 0, 0});  ///< at 45 degrees

/// A glossy black floor, its top at z = 0, under a lamp.
Scene Floor(const Eigen::Vector3d& lamp_w, double gloss) {
  Scene scene;
  scene.sun.intensity = 0;
  scene.sun.direction_w = {0, 0, 1};
  scene.sun.ambient = 0;
  scene.objects = {
      BoxObject(1, "floor", Role::kStructure, {0, 0, -0.05}, {8, 8, 0.1}, Print::kPlain)};
  for (Material& face : scene.objects[0].faces) face.gloss = gloss;
  Light lamp;
  lamp.center_w = lamp_w;
  lamp.intensity = 0.5;
  scene.lights = {lamp};
  return scene;
}

/// What the mirror adds to green.
cv::Mat1f Added(const Scene& scene, const Pose& T_wc, double time_s = 0) {
  RenderOptions options;
  options.time_s = time_s;
  const Camera camera = SmallCamera();
  const FrameRenderer matt(scene, camera);
  const FrameRenderer shiny(scene, camera, InstructionSet::kPinned, 1);
  cv::Mat1f added;
  cv::extractChannel(shiny.Render(T_wc, options).radiance - matt.Render(T_wc, options).radiance,
                     added, 1);
  return added;
}

TEST(MirrorLight, IsBrightestWhereTheLampsMirrorImageIs) {
  // The lamp's mirror image in the floor is as deep below it: seen through (0, 0, 0).
  const cv::Mat1f added = Added(Floor({0, 1, 1}, 1), kAbove);
  cv::Point at;
  double most = 0;
  cv::minMaxLoc(added, nullptr, &most, nullptr, &at);
  EXPECT_NEAR(at.x, SmallCamera().cx, 2);
  EXPECT_NEAR(at.y, SmallCamera().cy, 2);
  // Glass at 45 degrees, Schlick; a lamp of 0.5 at sqrt 2 m; a haze of 0.1 rad.
  const double glass = 0.04 + 0.96 * std::pow(1 - std::sqrt(0.5), 5);
  EXPECT_NEAR(most, glass * 0.5 / 2 / 0.01, 0.03 * most);
}

TEST(MirrorLight, GoesWithTheCamera) {
  // Half way between a camera and a lamp at the same height.
  const Pose aside = LookAt({0.6, -1, 1}, {0.3, 0, 0});
  cv::Point at;
  cv::minMaxLoc(Added(Floor({0, 1, 1}, 1), aside), nullptr, nullptr, nullptr, &at);
  EXPECT_NEAR(at.x, SmallCamera().cx, 2);
  EXPECT_NEAR(at.y, SmallCamera().cy, 2);
}

TEST(MirrorLight, OnAThingThatMovesIsThatOnOneThatStandsThere) {
  Scene moving = Floor({0.2, 1, 1}, 0);
  Object tray =
      BoxObject(2, "box", Role::kUnstructured, {-2, 0, 0.1}, {1, 1, 0.1}, Print::kPlain);
  for (Material& face : tray.faces) face.gloss = 1;
  tray.way = {{0, {-2, 0, 0.1}, 0}, {1, {2, 0, 0.1}, 90}};
  moving.objects.push_back(tray);
  Scene standing = moving;
  standing.objects[1].way.clear();
  standing.objects[1].center_w = {0, 0, 0.1};
  standing.objects[1].q_wo = Eigen::AngleAxisd(std::atan(1.0), Eigen::Vector3d::UnitZ());
  const cv::Mat1f expected = Added(standing, kAbove), added = Added(moving, kAbove, 0.5);
  double most = 0;
  cv::minMaxLoc(expected, nullptr, &most);
  ASSERT_GT(most, 0.1);
  EXPECT_LT(cv::norm(added, expected, cv::NORM_INF), 0.01 * most);
}

TEST(MirrorLight, IsNothingOnMattFacesNorUnlessAskedFor) {
  EXPECT_EQ(cv::norm(Added(Floor({0, 1, 1}, 0), kAbove), cv::NORM_INF), 0.0);
}

TEST(MirrorLight, OfTheRoomIsThatOfWhereTheMirrorLooks) {
  // Seen from above at 45 degrees: a face that lies looks at the ceiling, one that stands goes on
  // looking down, at the floor.
  Scene scene;
  scene.sun.ambient = 0.5;
  const double s = std::sqrt(0.5), glass = 0.04 + 0.96 * std::pow(1 - s, 5);
  MirrorSpot spot{.x_w = {0, 0, 0}, .look_w = {0, s, -s}, .n_w = {0, 0, 1}};
  const Eigen::Vector3d to_sun(0, 0, 1);
  EXPECT_NEAR(MirrorLight(scene, to_sun, spot)[1], glass * 0.5 * (1 + s), 1e-6);
  spot.n_w = {0, -1, 0};
  EXPECT_NEAR(MirrorLight(scene, to_sun, spot)[1], glass * 0.5 * (1 - s), 1e-6);
}

TEST(MirrorLight, OfTheSunNeedsIt) {
  Scene scene;
  scene.sun.ambient = 0;
  const Eigen::Vector3d to_sun = Eigen::Vector3d(0, 1, 1).normalized();
  MirrorSpot spot{.x_w = {0, 0, 0},
                  .look_w = Eigen::Vector3d(0, 1, -1).normalized(),
                  .n_w = Eigen::Vector3d::UnitZ()};
  EXPECT_EQ(MirrorLight(scene, to_sun, spot)[0], 0.0F);
  spot.sunlit = true;
  EXPECT_GT(MirrorLight(scene, to_sun, spot)[0], 1.0F);
}

// What a mirror shows is no brighter than the thing: a panel that sends I / r^2 to a face square
// to it, from a part A / r^2 of all directions, is pi I / A as bright as that face.
TEST(MirrorLight, OfAPanelIsNeverBrighterThanThePanelNorThanALampAsStrong) {
  const double s = std::sqrt(0.5), glass = 0.04 + 0.96 * std::pow(1 - s, 5);
  const MirrorSpot spot{
      .x_w = {0, 0, 0}, .look_w = {0, s, -s}, .n_w = {0, 0, 1}, .lights_seen = 1};
  const auto seen = [&](const Light& light) {
    Scene scene;
    scene.sun.ambient = 0;
    scene.lights = {light};
    return static_cast<double>(MirrorLight(scene, Eigen::Vector3d::UnitZ(), spot)[1]);
  };
  Light lamp;
  lamp.center_w = {0, 1, 1};
  lamp.intensity = 0.5;
  double last = seen(lamp);
  for (const double half_m : {0.001, 0.1, 0.2, 0.4, 0.8}) {
    Light panel = lamp;
    panel.kind = LightKind::kArea;
    panel.half_a_w = {half_m, 0, 0};
    panel.half_b_w = half_m * Eigen::Vector3d(0, -s, s);  // it looks at the spot
    const double one = seen(panel);
    EXPECT_LT(one, glass * M_PI * lamp.intensity / (4 * half_m * half_m)) << half_m;
    EXPECT_LT(one, last) << half_m << ": the larger the dimmer";
    EXPECT_GT(one, half_m < 0.01 ? 0.99 * last : 0.0) << half_m;  // the tiny one is a lamp
    last = one;
  }
}

// A joint in the middle of the highlight, between two halves that look as the whole does.
TEST(MirrorLight, OfTheSunGoesOnOverTheEdgeBetweenTwoThings) {
  Scene whole = Floor({0, 1, 1}, 1);
  whole.lights.clear();
  whole.sun.intensity = 0.8;
  whole.sun.direction_w = {0, -1, -1};
  Scene halves = whole;
  constexpr double kJoint_m = 0.003;
  halves.objects.push_back(halves.objects[0]);
  halves.objects[1].id = 2;
  halves.objects[1].name = "other_half";
  for (const int side : {0, 1}) {
    Object& half = halves.objects[static_cast<std::size_t>(side)];
    half.size.x() = 4;
    half.center_w.x() = kJoint_m + (side == 0 ? -2 : 2);
  }
  const cv::Mat1f expected = Added(whole, kAbove), added = Added(halves, kAbove);
  double most = 0;
  cv::minMaxLoc(expected, nullptr, &most);
  ASSERT_GT(most, 0.1);
  EXPECT_LT(cv::norm(added, expected, cv::NORM_INF), 0.02 * most);
}

TEST(MirrorLight, OfALampIsNothingWhereSomethingStandsBeforeIt) {
  Scene scene = Floor({0, 1, 1}, 1);
  scene.lights.push_back(scene.lights[0]);
  const auto seen = [&](unsigned lights) {
    const MirrorSpot spot{.x_w = {0, 0, 0},
                          .look_w = Eigen::Vector3d(0, 1, -1).normalized(),
                          .n_w = Eigen::Vector3d::UnitZ(),
                          .lights_seen = lights};
    return MirrorLight(scene, Eigen::Vector3d::UnitZ(), spot)[1];
  };
  EXPECT_EQ(seen(0b00), 0.0F);
  EXPECT_GT(seen(0b10), 0.0F);
  EXPECT_FLOAT_EQ(seen(0b10), seen(0b01));
  EXPECT_FLOAT_EQ(seen(0b11), 2 * seen(0b01));
}

}  // namespace
}  // namespace sim
