#include "sim/sensor/depth/depth_sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "tests/sim/sensor/sensor_measurements.h"

namespace sim {
namespace {

Rendering View(const Scene& scene, const Camera& camera, const Pose& T_wc = LookAlongY()) {
  RenderOptions options;
  options.colour = false;
  options.projector_offset_m = KinectModel{}.projector_offset_m;
  return FrameRenderer(scene, camera).Render(T_wc, options);
}

/// The curve again, from the paper's printed constants.
double Kinect1Sigma(double z) { return 0.0012 + 0.0019 * std::pow(z - 0.4, 2); }

struct Moments {
  double mean = 0, sd = 0, lag1 = 0, share = 0;
};

/// Of z - truth over the image and five frames: 96 000 pixels, about 96 000 / 9 independent.
Moments ErrorMoments(double z_m, const KinectModel& model) {
  const Rendering rendering = View(OneBoard(z_m), SmallCamera());
  double count = 0, sum = 0, squares = 0, product = 0;
  for (std::uint64_t frame = 0; frame < 5; ++frame) {
    const cv::Mat1d z = MeasureDepth(rendering, model, PixelNoise(11, frame));
    for (int v = 0; v < z.rows; ++v) {
      for (int u = 0; u + 1 < z.cols; ++u) {
        if (!(z(v, u) > 0) || !(z(v, u + 1) > 0)) continue;
        const double e = z(v, u) - z_m;
        ++count;
        sum += e;
        squares += e * e;
        product += e * (z(v, u + 1) - z_m);
      }
    }
  }
  Moments m;
  m.share = count / (5.0 * 120 * 159);
  m.mean = sum / count;
  const double variance = squares / count - m.mean * m.mean;
  m.sd = std::sqrt(variance);
  m.lag1 = (product / count - m.mean * m.mean) / variance;
  return m;
}

class KinectNoiseAt : public testing::TestWithParam<double> {};

TEST_P(KinectNoiseAt, HasTheStandardDeviationOfThePublishedCurve) {
  const Moments m = ErrorMoments(GetParam(), {});
  EXPECT_NEAR(m.sd, Kinect1Sigma(GetParam()), 0.05 * Kinect1Sigma(GetParam()));
}

TEST_P(KinectNoiseAt, IsUnbiasedToATenthOfAStep) {
  const double step_m = GetParam() * GetParam() / 351.3;
  EXPECT_LT(std::abs(ErrorMoments(GetParam(), {}).mean), 0.1 * step_m);
}

TEST_P(KinectNoiseAt, LeavesOnlyWholeDisparitySteps) {
  const Rendering rendering = View(OneBoard(GetParam()), SmallCamera());
  const cv::Mat1d z = MeasureDepth(rendering, {}, PixelNoise(1, 0));
  for (int u = 0; u < z.cols; ++u) {
    const double steps = 351.3 / z(60, u);
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Depths, KinectNoiseAt, testing::Values(0.6, 1.0, 1.5, 2.0));

// A 3x3 mean shares six of nine numbers with its neighbour: correlation 2/3; rounding dilutes
// it.
TEST(KinectNoise, IsCorrelatedOverNeighbouringPixels) {
  const Moments m = ErrorMoments(0.6, {.quantise = false});
  EXPECT_NEAR(m.lag1, 2.0 / 3.0, 0.03);
}

TEST(KinectNoise, GrowsOnSurfacesSeenAtAGrazingAngle) {
  EXPECT_DOUBLE_EQ(AxialSigma(1.0, 0.5), Kinect1Sigma(1.0));
  const double theta = 1.3, ratio = theta / (M_PI / 2 - theta);
  EXPECT_DOUBLE_EQ(AxialSigma(1.0, theta), Kinect1Sigma(1.0) + 0.0001 * ratio * ratio);
}

class KinectNoiseOnTilted : public testing::TestWithParam<double> {};

// From the paper's printed constants, as Kinect1Sigma; the term in theta begins at 60 deg.
TEST_P(KinectNoiseOnTilted, HasTheStandardDeviationOfThePublishedCurve) {
  const DepthModel model = KinectModel{.projector_offset_m = 0};
  const Scene board = TiltedBoard(1.0, GetParam() * M_PI / 180);
  const Rendering rendering = SensorView(board, NarrowCamera(), model);
  const auto m = MeasureErrors(rendering, NarrowCamera(), model, 5, [](double z, double theta) {
    const double ratio = theta / (M_PI / 2 - theta);
    const bool grazing = theta > M_PI / 3;
    return Kinect1Sigma(z) + (grazing ? 0.0001 / std::sqrt(z) * ratio * ratio : 0.0);
  });
  EXPECT_NEAR(m.sd, 1.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Degrees, KinectNoiseOnTilted,
                         testing::Values(0.0, 20.0, 40.0, 57.0, 65.0, 70.0, 75.0));

TEST(KinectSwitchedOff, GivesTheExactDepthBack) {
  Rendering rendering = View(SmallDesk(), SmallCamera(), SmallArc(1)[0].T_wc);
  rendering.projector_lit = cv::Mat1b();
  const KinectModel off{.min_depth_m = 0,
                        .max_depth_m = 1e9,
                        .max_incidence_rad = 4,
                        .noise_scale = 0,
                        .lateral_scale = 0,
                        .quantise = false};
  const cv::Mat1d z = MeasureDepth(rendering, off, PixelNoise(1, 0));
  EXPECT_EQ(cv::countNonZero(z != rendering.depth_m), 0);
}

TEST(KinectDepth, StaysInvalidWhereNothingIsHit) {
  const Rendering rendering = View(OneBoard(1.0, 0.4), SmallCamera());
  const cv::Mat1d z = MeasureDepth(rendering, {}, PixelNoise(1, 0));
  EXPECT_EQ(cv::countNonZero((rendering.depth_m == 0) & (z != 0)), 0);
}

TEST(KinectDepth, EndsAtTheRangeLimits) {
  for (const double z_m : {0.45, 4.6}) {
    EXPECT_EQ(cv::countNonZero(
                  MeasureDepth(View(OneBoard(z_m), SmallCamera()), {}, PixelNoise(1, 0)) != 0),
              0);
  }
  const cv::Mat1d near =
      MeasureDepth(View(OneBoard(0.45), SmallCamera()), {.min_depth_m = 0.4}, PixelNoise(1, 0));
  EXPECT_EQ(cv::countNonZero(near), 160 * 120);
}

TEST(KinectDepth, IsMissingOnAFloorSeenFlatterThanEightyDegrees) {
  Scene scene;
  scene.objects = {BoxObject(1, "floor", Role::kStructure, {0, 0, -0.05}, {20, 20, 0.1})};
  const Camera camera = SmallCamera();
  const Rendering rendering = View(scene, camera, LookAt({0, 0, 0.3}, {0, 1, 0.2}));
  const cv::Mat1d z = MeasureDepth(rendering, {.lateral_scale = 0}, PixelNoise(1, 0));
  int flat = 0;
  for (int v = 0; v < z.rows; ++v) {
    const float c = rendering.incidence_cos(v, 80);
    if (c > 0 && c < std::cos(80.0 * M_PI / 180)) {
      ++flat;
      EXPECT_EQ(z(v, 80), 0.0);
    }
  }
  EXPECT_GT(flat, 0);
}

// Projector 75 mm to the right: a board's left edge at z_near hides f b (1/z_near - 1/z_far)
// pixels of the wall behind it, on its left.
TEST(ProjectorShadow, HasTheWidthThatTheBaselineGives) {
  const double z_near = 0.8, z_far = 1.6;
  Scene scene = OneBoard(z_far);
  scene.objects.push_back(
      BoxObject(2, "box", Role::kRegular, {0, z_near + 0.0005, 0}, {0.2, 0.001, 0.2}));
  const Camera camera;
  const Rendering rendering = View(scene, camera);
  const cv::Mat1d z =
      MeasureDepth(rendering, {.noise_scale = 0, .lateral_scale = 0}, PixelNoise(1, 0));
  const double expected = camera.fx * 0.075 * (1 / z_near - 1 / z_far);
  int width = 0;
  for (int u = 0; u < camera.width; ++u) {
    if (z(240, u) > 0) continue;
    ++width;
    EXPECT_LT(u, camera.cx);
  }
  EXPECT_NEAR(width, expected, 1.01);  // one pixel at either end
}

TEST(LateralNoise, MovesEdgesButNeverTheDepthInsideASurface) {
  const double z_near = 0.8, z_far = 1.6;
  Scene scene = OneBoard(z_far);
  scene.objects.push_back(
      BoxObject(2, "box", Role::kRegular, {0, z_near + 0.0005, 0}, {0.2, 0.001, 0.2}));
  Rendering rendering = View(scene, Camera{});
  rendering.projector_lit = cv::Mat1b();
  const cv::Mat1d z =
      MeasureDepth(rendering, {.noise_scale = 0, .quantise = false}, PixelNoise(1, 0));
  const double edge = 319.5 - 525 * 0.1 / z_near;
  int moved = 0;
  for (int v = 200; v < 280; ++v) {
    for (int u = 200; u < 320; ++u) {
      if (z(v, u) == rendering.depth_m(v, u)) continue;
      ++moved;
      EXPECT_LT(std::abs(u - edge), 6.0);  // sigma_L is 0.8 px: beyond 6 px 1e-13
      EXPECT_TRUE(z(v, u) == z_near || std::abs(z(v, u) - z_far) < 1e-9 ||
                  std::abs(z(v, u) - z_near) < 1e-9);
    }
  }
  EXPECT_GT(moved, 20);
}

// A frontal board on the left of one that is too flat to be measured: whoever looks at the second,
// from whichever side of the edge, has nothing, and whoever looks at the first has its depth.
TEST(LateralNoise, TakesTheAngleOfTheSurfaceThatIsSeenWithItsDepth) {
  constexpr int kEdge = 80;
  const cv::Size size(160, 120);
  Rendering rendering;
  rendering.depth_m = cv::Mat1d(size, 1.0);
  rendering.incidence_cos = cv::Mat1f(size, 1.0F);
  rendering.plane_id = cv::Mat1w(size, ushort{1});
  rendering.object_id = cv::Mat1w(size, ushort{1});
  const cv::Rect right(kEdge, 0, size.width - kEdge, size.height);
  rendering.depth_m(right).setTo(1.3);
  rendering.incidence_cos(right).setTo(std::cos(85 * M_PI / 180));
  rendering.plane_id(right).setTo(2);
  const cv::Mat1d z =
      MeasureDepth(rendering, {.noise_scale = 0, .quantise = false}, PixelNoise(1, 0));
  int lost = 0, gained = 0;
  for (int v = 0; v < z.rows; ++v) {
    for (int u = 0; u < z.cols; ++u) {
      if (z(v, u) == 0) {
        lost += u < kEdge;
        continue;
      }
      EXPECT_NEAR(z(v, u), 1.0, 1e-9) << u << " " << v;
      gained += u >= kEdge;
    }
  }
  EXPECT_GT(lost, 10);
  EXPECT_GT(gained, 10);
}

TEST(EncodedDepth, RoundsToNearestAndDropsWhatDoesNotFit) {
  const cv::Mat1d z = (cv::Mat1d(1, 5) << 0.0, 1.00009, 1.00011, 13.107, 13.2);
  const cv::Mat1w units = EncodeDepth(z, 5000);
  EXPECT_EQ(units(0, 0), 0);
  EXPECT_EQ(units(0, 1), 5000);
  EXPECT_EQ(units(0, 2), 5001);
  EXPECT_EQ(units(0, 3), 65535);
  EXPECT_EQ(units(0, 4), 0);
}

}  // namespace
}  // namespace sim
