#include "sim/sensor/depth/azure_sensor.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/base/angle.h"
#include "sim/sensor/depth/corner_glow.h"
#include "tests/sim/sensor/sensor_measurements.h"

namespace sim {
namespace {

/// The curve again, from its printed constants.
double PublishedAzureSigma(double z) { return z < 0.5 ? 0.0005 : 0.0005 + 0.001 * (z - 0.5); }

AzureModel WithoutSystematicErrors() {
  return {.multipath_m = 0, .multipath_loss = 0, .wiggle_m = 0, .session_offset_m = 0};
}

class AzureNoiseAt : public testing::TestWithParam<double> {};

TEST_P(AzureNoiseAt, HasTheStandardDeviationOfThePublishedCurve) {
  const DepthModel model = WithoutSystematicErrors();
  const Rendering rendering = SensorView(OneBoard(GetParam()), NarrowCamera(), model);
  const ErrorMoments m = MeasureErrors(rendering, NarrowCamera(), model, 3,
                                       [](double z, double) { return PublishedAzureSigma(z); });
  EXPECT_NEAR(m.sd, 1.0, 0.05);
  EXPECT_EQ(m.share, 1.0);
}

TEST_P(AzureNoiseAt, IsUnbiasedToATenthOfAStep) {
  const DepthModel model = WithoutSystematicErrors();
  const Rendering rendering = SensorView(OneBoard(GetParam()), NarrowCamera(), model);
  const ErrorMoments m =
      MeasureErrors(rendering, NarrowCamera(), model, 3, [](double, double) { return 0.001; });
  EXPECT_LT(std::abs(m.mean), 0.1);
}

TEST_P(AzureNoiseAt, LeavesOnlyWholeMillimetres) {
  const DepthModel model = AzureModel{};
  const Rendering rendering = SensorView(OneBoard(GetParam()), NarrowCamera(), model);
  const cv::Mat1d z = MeasureDepth(rendering, model, NarrowCamera(), 3, 0);
  EXPECT_GT(cv::countNonZero(z), 0);
  for (const double depth : z) EXPECT_NEAR(depth * 1000, std::round(depth * 1000), 1e-9);
}

// 2 mm sin(2 pi z / 0.75 m).
TEST_P(AzureNoiseAt, IsOffByTheCyclicError) {
  AzureModel azure = WithoutSystematicErrors();
  azure.wiggle_m = 0.002;
  const DepthModel model = azure;
  const Rendering rendering = SensorView(OneBoard(GetParam()), NarrowCamera(), model);
  const ErrorMoments m =
      MeasureErrors(rendering, NarrowCamera(), model, 3, [](double, double) { return 1.0; });
  EXPECT_NEAR(m.mean, 0.002 * std::sin(2 * M_PI * GetParam() / 0.75), 0.0001);
}

INSTANTIATE_TEST_SUITE_P(Depths, AzureNoiseAt, testing::Values(0.6, 1.0, 1.5, 2.0));

class AzureNoiseOnTilted : public testing::TestWithParam<double> {};

TEST_P(AzureNoiseOnTilted, GrowsAsLightFails) {
  const DepthModel model = WithoutSystematicErrors();
  const Scene board = TiltedBoard(1.5, GetParam() * M_PI / 180);
  const Rendering rendering = SensorView(board, NarrowCamera(), model);
  const ErrorMoments m =
      MeasureErrors(rendering, NarrowCamera(), model, 3, [](double z, double theta) {
        return std::min(0.017, PublishedAzureSigma(z) / std::sqrt(std::cos(theta)));
      });
  EXPECT_NEAR(m.sd, 1.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Degrees, AzureNoiseOnTilted,
                         testing::Values(0.0, 20.0, 40.0, 60.0, 70.0, 80.0));

TEST(AzureNoise, IsNeverWorseThanTheMakerStates) {
  EXPECT_EQ(AzureSigma(3.8, 0.001), 0.017);
  EXPECT_GT(AzureSigma(1.0, 1.0, 0.15), 2 * AzureSigma(1.0, 1.0));
}

TEST(AzureSwitchedOff, GivesTheExactDepthBack) {
  const Rendering rendering =
      SensorView(SmallDesk(), SmallCamera(), AzureAllOff(), SmallArc(1)[0].T_wc);
  const cv::Mat1d z = MeasureDepth(rendering, AzureAllOff(), SmallCamera(), 1, 0);
  EXPECT_EQ(cv::countNonZero(z != rendering.depth_m), 0);
}

TEST(AzureDepth, EndsAtTheRangeLimits) {
  for (const double z_m : {0.49, 3.87}) {
    const Rendering rendering = SensorView(OneBoard(z_m), NarrowCamera(), AzureModel{});
    EXPECT_EQ(cv::countNonZero(MeasureDepth(rendering, AzureModel{}, NarrowCamera(), 1, 0)), 0);
  }
}

// Of a 640 x 480 view 62.7 x 49.1 deg the hexagon of 75 x 65 deg leaves the four corners out.
TEST(AzureField, IsAHexagon) {
  AzureModel azure = AzureAllOff();
  azure.hexagon = true;
  const Camera camera = SmallCamera();
  const cv::Mat1d z =
      MeasureDepth(SensorView(OneBoard(1.0), camera, azure), azure, camera, 1, 0);
  const double x_max = std::tan(37.5 * M_PI / 180), y_max = std::tan(32.5 * M_PI / 180);
  for (const int v : {0, 20, 60, 119}) {
    const double y = std::abs((v - camera.cy) / camera.fy);
    const double edge_u = camera.cx + camera.fx * x_max * (1 - 0.5 * y / y_max);
    for (int u = 80; u < camera.width; ++u)
      EXPECT_EQ(z(v, u) > 0, u <= edge_u) << u << " " << v;
  }
  EXPECT_EQ(z(0, 0), 0.0);
}

// One pixel from a straight edge a quarter of the footprint lies beyond it. Light goes as
// 1/z^2 (cos is the same within 1 %).
TEST(FlyingPixels, LieWhereTheLightOfTheFootprintPutsThem) {
  const double z_near = 1.0, z_far = 1.06;  // nearer than 10 cm: never refused
  AzureModel azure = AzureAllOff();
  azure.flying_pixels = true;
  Camera camera;
  camera.cx = 319.3;  // no ray meets the board's edge itself, where its side is seen too
  const Rendering rendering = SensorView(BoardBeforeWall(z_near, z_far), camera, azure);
  const cv::Mat1d z = MeasureDepth(rendering, azure, camera, 1, 0);
  int first = 200;  // leftmost pixel of the board
  while (rendering.object_id(240, first) != 2) ++first;
  const double far_light = 1 / (z_far * z_far);
  const auto mixed = [&](double far_share) {
    return ((1 - far_share) * z_near + far_share * far_light * z_far) /
           ((1 - far_share) + far_share * far_light);
  };
  EXPECT_NEAR(z(240, first), mixed(0.25), 2e-4);
  EXPECT_NEAR(z(240, first - 1), mixed(0.75), 2e-4);
  EXPECT_EQ(z(240, first + 1), rendering.depth_m(240, first + 1));
  EXPECT_EQ(z(240, first - 2), rendering.depth_m(240, first - 2));
}

TEST(FlyingPixels, AreRefusedWhereFarSurfacesMixEvenly) {
  AzureModel azure = AzureAllOff();
  azure.flying_pixels = true;
  const Camera camera;
  const Rendering rendering = SensorView(BoardBeforeWall(0.8, 1.2), camera, azure);
  const cv::Mat1d z = MeasureDepth(rendering, azure, camera, 1, 0);
  int first = 200;
  while (rendering.object_id(240, first) != 2) ++first;
  // Far share of light: inside 0.25 r / (0.75 + 0.25 r) = 0.13, outside 0.75 r / ... = 0.57,
  // r = (0.8 / 1.2)^2: the first stays, drawn to the wall; the second is refused.
  EXPECT_GT(z(240, first), 0.8 + 0.03);
  EXPECT_LT(z(240, first), 0.8 + 0.08);
  EXPECT_EQ(z(240, first - 1), 0.0);
}

/// A floor and a wall that meet at y = 1, z = 0, seen from above.
Scene FloorAndWall() {
  Scene scene;
  scene.objects = {BoxObject(1, "floor", Role::kStructure, {0, 0, -0.05}, {4, 4, 0.1}),
                   BoxObject(2, "wall", Role::kStructure, {0, 1.05, 1.0}, {4, 0.1, 2.0})};
  return scene;
}

TEST(CornerOfTwoWalls, LooksFartherByTheMultipathOfItsDistance) {
  AzureModel azure = AzureAllOff();
  azure.multipath_m = 0.0075;
  const Camera camera;
  const Pose T_wc = LookAt({0, 0.2, 0.6}, {0, 1, 0});
  const Rendering rendering = SensorView(FloorAndWall(), camera, azure, T_wc);
  const cv::Mat1d z = MeasureDepth(rendering, azure, camera, 1, 0);
  const double footprint_m = 2 * 1.0 / camera.fy / 0.6;  // two pixels aslant at 1 m
  int lit = 0;
  for (int v = 0; v < z.rows; ++v) {
    const Eigen::Vector3d p_w = T_wc * (rendering.depth_m(v, 320) * camera.Ray(320, v));
    const double distance = rendering.object_id(v, 320) == 1 ? 1.0 - p_w.y() : p_w.z();
    const double expected = 0.0075 * std::max(0.0, 1 - distance / 0.05);
    EXPECT_NEAR(z(v, 320) - rendering.depth_m(v, 320), expected, 0.0075 * footprint_m / 0.05);
    if (expected > 0.001) ++lit;
  }
  EXPECT_GT(lit, 20);
}

TEST(CornerOfTwoWalls, LosesTheStatedShareOfItsPixels) {
  AzureModel azure = AzureAllOff();
  azure.multipath_loss = 0.2;
  const Camera camera;
  const Rendering rendering =
      SensorView(FloorAndWall(), camera, azure, LookAt({0, 0.2, 0.6}, {0, 1, 0}));
  const cv::Mat1f glow = CornerGlow(rendering, camera, azure.multipath_reach_m);
  const cv::Mat1d z = MeasureDepth(rendering, azure, camera, 1, 0);
  ASSERT_GT(cv::countNonZero(glow > 0), 10000);
  // By the glow: 20 % in the corner, none 5 cm away.
  for (double low = 0; low < 0.99; low += 0.25) {
    const cv::Mat band = (glow > low) & (glow <= low + 0.25);
    const double near = cv::countNonZero(band);
    const double lost = cv::countNonZero(band & (z == 0));
    const double expected = 0.2 * cv::mean(glow, band)[0];
    EXPECT_NEAR(lost / near, expected, 5 * std::sqrt(expected * (1 - expected) / near));
  }
  EXPECT_EQ(cv::countNonZero((glow == 0) & (z == 0) & (rendering.depth_m > 0)), 0);
}

/// The same, its wall leaning back from upright, or over the floor where that is negative.
Scene FloorAndLeaningWall(double back_deg) {
  Scene scene = FloorAndWall();
  Object& wall = scene.objects[1];
  wall.q_wo = QuaternionFromRpyDeg({-back_deg, 0, 0});
  wall.center_w = Eigen::Vector3d(0, 1, 0) + wall.q_wo * Eigen::Vector3d(0, 0.05, 1);
  return scene;
}

// The normals of floor and wall are 90 degrees less the lean apart.
TEST(CornerOfTwoWalls, GlowsTheLessTheFlatterItIs) {
  constexpr double kReach_m = 0.05;
  const Camera camera;
  const Pose T_wc = LookAt({0, 0.2, 0.6}, {0, 1, 0});
  for (const double back_deg : {-30.0, 0.0, 30.0, 60.0}) {
    const Rendering rendering =
        SensorView(FloorAndLeaningWall(back_deg), camera, AzureAllOff(), T_wc);
    const cv::Mat1f glow = CornerGlow(rendering, camera, kReach_m);
    const double strongest = std::min(1.0, 1 - std::sin(DegToRad(back_deg)));
    int lit = 0;
    for (int v = 0; v < glow.rows; ++v) {
      const Eigen::Vector3d p_w = T_wc * (rendering.depth_m(v, 320) * camera.Ray(320, v));
      const double share = std::max(0.0, 1 - std::hypot(p_w.y() - 1, p_w.z()) / kReach_m);
      // Two pixels aslant at 1 m are a fifth of the reach.
      EXPECT_NEAR(static_cast<double>(glow(v, 320)), strongest * share, 0.2 * strongest)
          << back_deg << " degrees, row " << v;
      lit += share > 0.2;
    }
    EXPECT_GT(lit, 20) << back_deg;
  }
}

// A bar over the floor and before the wall, 2 cm wide: in the image the corner is beside it.
TEST(CornerOfTwoWalls, DoesNotGlowOnWhatIsBeforeIt) {
  Scene scene = FloorAndWall();
  scene.objects.push_back(
      BoxObject(3, "bar", Role::kRegular, {0, 0.975, 0.025}, {0.02, 0.01, 0.02}));
  const Camera camera;
  const Rendering rendering =
      SensorView(scene, camera, AzureAllOff(), LookAt({0, 0.2, 0.6}, {0, 1, 0}));
  const cv::Mat1f glow = CornerGlow(rendering, camera, 0.05);
  const cv::Mat on_bar = rendering.object_id == 3;
  EXPECT_GT(cv::countNonZero(on_bar), 50);
  EXPECT_EQ(cv::countNonZero((glow > 0) & on_bar), 0);
  EXPECT_GT(cv::countNonZero(glow > 0), 1000);
}

TEST(ConvexEdge, DoesNotGlow) {
  Scene scene;
  scene.objects = {BoxObject(1, "box", Role::kRegular, {0, 1, 0}, {0.3, 0.3, 0.3})};
  const Camera camera;
  const Rendering rendering =
      SensorView(scene, camera, AzureAllOff(), LookAt({0.5, 0.3, 0.5}, {0, 1, 0}));
  EXPECT_EQ(cv::countNonZero(CornerGlow(rendering, camera, 0.05)), 0);
}

TEST(SessionOffset, IsOneNumberForAllFramesOfASeed) {
  AzureModel azure = AzureAllOff();
  azure.session_offset_m = 0.005;
  const Rendering rendering = SensorView(OneBoard(1.0), NarrowCamera(), azure);
  const auto offset = [&](std::uint64_t seed, std::uint64_t frame) {
    return MeasureDepth(rendering, azure, NarrowCamera(), seed, frame)(50, 50) - 1.0;
  };
  double lowest = 1, highest = -1;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    EXPECT_EQ(offset(seed, 0), offset(seed, 7));
    lowest = std::min(lowest, offset(seed, 0));
    highest = std::max(highest, offset(seed, 0));
  }
  EXPECT_LT(highest, 0.005 + 1e-9);
  EXPECT_GT(lowest, -0.005 - 1e-9);
  EXPECT_GT(highest - lowest, 0.009);
}

// Each pixel is a surface of its own, which its depth names: so depth tells where a pixel looked.
TEST(AzureJitter, MovesAcrossAndDownByTheStatedSdAndEachByItself) {
  const cv::Size size(160, 120);
  Rendering rendering;
  rendering.depth_m.create(size);
  rendering.plane_id.create(size);
  rendering.object_id = cv::Mat1w(size, ushort{1});
  constexpr double kApart_m = 1e-4;
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const int index = v * size.width + u;
      rendering.depth_m(v, u) = 1 + kApart_m * index;
      rendering.plane_id(v, u) = static_cast<ushort>(index + 1);
    }
  }
  AzureModel azure = AzureAllOff();
  azure.lateral_px = 2;
  const cv::Mat1d z = MeasureDepth(rendering, azure, SmallCamera(), 1, 0);
  constexpr int kReach_px = 10;  // five sd
  double count = 0, across2 = 0, down2 = 0, both = 0;
  for (int v = kReach_px; v < size.height - kReach_px; ++v) {
    for (int u = kReach_px; u < size.width - kReach_px; ++u) {
      const int index = static_cast<int>(std::lround((z(v, u) - 1) / kApart_m));
      const double across = index % size.width - u, down = index / size.width - v;
      ++count;
      across2 += across * across, down2 += down * down, both += across * down;
    }
  }
  const double sd = std::sqrt(4 + 1 / 12.0);  // rounded to whole pixels
  EXPECT_NEAR(std::sqrt(across2 / count), sd, 5 * sd / std::sqrt(2 * count));
  EXPECT_NEAR(std::sqrt(down2 / count), sd, 5 * sd / std::sqrt(2 * count));
  EXPECT_NEAR(both / std::sqrt(across2 * down2), 0, 5 / std::sqrt(count));
}

}  // namespace
}  // namespace sim
