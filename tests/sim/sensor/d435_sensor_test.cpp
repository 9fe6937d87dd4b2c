#include "sim/sensor/depth/d435_sensor.h"

#include <gtest/gtest.h>

#include <map>
#include <opencv2/core.hpp>

#include "sim/sensor/depth/rounded_sigma.h"
#include "tests/sim/sensor/sensor_measurements.h"

namespace sim {
namespace {

/// The law again, from its printed constants.
double PublishedD435Sigma(double z) { return z * z * 0.08 / 21.57; }

D435Model D435AllOff() {
  return {.baseline_m = 0,
          .subpixel_px = 0,
          .grid_px = 0,
          .ripple_px = 0,
          .fattening_px = 0,
          .min_share = 0,
          .min_depth_m = 0,
          .max_depth_m = 1e9,
          .rounding_m = 0};
}

TEST(RoundedSigma, IsThatOfTheModelItIsAskedForWhateverWasAskedBefore) {
  const D435Model usual;
  const double z_m = 1.3;
  const double before = RoundedSigma::Of(usual)->At(z_m);
  EXPECT_EQ(before, RoundedSigma(usual).At(z_m));
  for (double D435Model::*const field :
       {&D435Model::subpixel_px, &D435Model::grid_px, &D435Model::ripple_px}) {
    D435Model other = usual;
    other.*field *= 1.3;
    EXPECT_EQ(RoundedSigma::Of(other)->At(z_m), RoundedSigma(other).At(z_m));
    EXPECT_NE(RoundedSigma(other).At(z_m), before);
  }
}

// It would take hours to sum over its steps.
TEST(RoundedSigma, TakesAGridThatIsFineBesideTheNoiseForNone) {
  const RoundedSigma none(D435Model{.grid_px = 0});
  for (const double grid_px : {0.005, 1e-9}) {
    const RoundedSigma fine(D435Model{.grid_px = grid_px});
    for (const double z_m : {0.3, 0.59, 1.3}) {
      EXPECT_NEAR(fine.At(z_m), none.At(z_m), 1e-3 * none.At(z_m)) << grid_px << ", " << z_m;
    }
  }
}

TEST(RoundedSigma, LeavesASixthOfTheGridWhereTheNoiseIsLess) {
  const D435Model quiet{.subpixel_px = 0.003};
  const RoundedSigma sigma(quiet);
  for (double z_m = 0.3; z_m < 1.5; z_m += 0.01) {
    EXPECT_GE(sigma.At(z_m), 0.999 * quiet.grid_px / 6) << z_m;
  }
}

class D435NoiseAt : public testing::TestWithParam<double> {
 protected:
  /// Noise alone. No blind band: the narrow view would be all blind.
  ErrorMoments Errors(double ripple_px, int frames) const {
    const DepthModel model = D435Model{.baseline_m = 0, .ripple_px = ripple_px};
    const Rendering rendering = SensorView(OneBoard(GetParam()), NarrowCamera(), model);
    return MeasureErrors(rendering, NarrowCamera(), model, frames,
                         [](double z, double) { return PublishedD435Sigma(z); });
  }
};

// 70 % of the variance is shared by about 7 x 7 pixels: 40 frames of 160 x 120 hold 15 700
// independent numbers, sd known to 0.6 %.
TEST_P(D435NoiseAt, HasTheStandardDeviationOfThePublishedLaw) {
  const ErrorMoments m = Errors(0.03, 40);
  EXPECT_NEAR(m.sd, 1.0, 0.03);
  EXPECT_EQ(m.share, 1.0);
}

TEST_P(D435NoiseAt, IsUnbiasedToATenthOfAStepWithoutRipple) {
  const double z = GetParam(), step_m = std::max(0.001, z * z / 32 / 21.57);
  EXPECT_LT(std::abs(Errors(0, 40).mean * PublishedD435Sigma(z)), 0.1 * step_m);
}

TEST_P(D435NoiseAt, IsOffByTheSubpixelRipple) {
  const double z = GetParam(), d = 21.57 / z;
  const double expected = -z * z / 21.57 * 0.03 * std::sin(2 * M_PI * d);
  EXPECT_NEAR(Errors(0.03, 40).mean * PublishedD435Sigma(z), expected,
              0.05 * PublishedD435Sigma(z));
}

TEST_P(D435NoiseAt, LeavesOnlyWholeStepsOfDisparity) {
  const D435Model model{.baseline_m = 0, .rounding_m = 0};
  const Rendering rendering = SensorView(OneBoard(GetParam()), NarrowCamera(), model);
  std::map<long, int> histogram;
  for (const double z : MeasureDepth(rendering, model, NarrowCamera(), 3, 0)) {
    const double steps = 32 * 21.57 / z;
    EXPECT_NEAR(steps, std::round(steps), 1e-6);
    ++histogram[std::lround(steps)];
  }
  // sd 0.08 px is 2.6 steps: the histogram has no gap between its ends' neighbours.
  EXPECT_GT(histogram.size(), 10U);
  const long first = histogram.begin()->first + 3, last = histogram.rbegin()->first - 3;
  for (long step = first; step <= last; ++step) EXPECT_TRUE(histogram.count(step)) << step;
}

TEST_P(D435NoiseAt, LeavesOnlyWholeMillimetres) {
  const D435Model model{.baseline_m = 0};
  const Rendering rendering = SensorView(OneBoard(GetParam()), NarrowCamera(), model);
  const cv::Mat1d measured = MeasureDepth(rendering, model, NarrowCamera(), 3, 0);
  EXPECT_GT(cv::countNonZero(measured), 0);
  for (const double z : measured) EXPECT_NEAR(z * 1000, std::round(z * 1000), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Depths, D435NoiseAt, testing::Values(0.6, 1.0, 1.5, 2.0));

// Where disparity's steps and millimetres are near 1 : 2 and 1 : 1 the roundings go along with
// the noise; at any place in a millimetre the sd must still be the law's.
TEST(D435Noise, KeepsItsSdWhereTheTwoRoundingsBeat) {
  const DepthModel model = D435Model{.baseline_m = 0};
  for (const double z : {0.5870, 0.5873, 0.6005, 0.8210, 0.8297, 0.9004}) {
    const Rendering rendering = SensorView(OneBoard(z), NarrowCamera(), model);
    const ErrorMoments m =
        MeasureErrors(rendering, NarrowCamera(), model, 20,
                      [](double at, double) { return PublishedD435Sigma(at); });
    EXPECT_NEAR(m.sd, 1.0, 0.04) << z;
  }
}

// A 7 x 7 mean shares 42 of 49 numbers with its neighbour: correlation 0.7 * 6/7.
TEST(D435Noise, IsCorrelatedOverTheMatchingWindow) {
  D435Model model = D435AllOff();
  model.subpixel_px = 0.08;
  const Rendering rendering = SensorView(OneBoard(1.0), NarrowCamera(), model);
  double square = 0, product = 0;
  for (std::uint64_t frame = 0; frame < 20; ++frame) {
    const cv::Mat1d z = MeasureDepth(rendering, model, NarrowCamera(), 5, frame);
    for (int v = 0; v < z.rows; ++v) {
      for (int u = 0; u + 1 < z.cols; ++u) {
        square += (z(v, u) - 1) * (z(v, u) - 1);
        product += (z(v, u) - 1) * (z(v, u + 1) - 1);
      }
    }
  }
  EXPECT_NEAR(product / square, 0.7 * 6 / 7, 0.03);
}

TEST(D435SwitchedOff, GivesTheExactDepthBack) {
  const Rendering rendering =
      SensorView(SmallDesk(), SmallCamera(), D435AllOff(), SmallArc(1)[0].T_wc);
  const cv::Mat1d z = MeasureDepth(rendering, D435AllOff(), SmallCamera(), 1, 0);
  EXPECT_EQ(cv::countNonZero(z != rendering.depth_m), 0);
}

TEST(D435Depth, EndsAtTheRangeLimits) {
  const D435Model model{.baseline_m = 0};
  for (const double z_m : {0.27, 10.1}) {
    const Rendering rendering = SensorView(OneBoard(z_m, 100), NarrowCamera(), model);
    EXPECT_EQ(cv::countNonZero(MeasureDepth(rendering, model, NarrowCamera(), 1, 0)), 0);
  }
}

TEST(LeftBand, IsBlindAsFarAsTheRightImagerDoesNotReach) {
  D435Model model = D435AllOff();
  model.baseline_m = 0.05015;
  const Camera camera;
  const cv::Mat1d z =
      MeasureDepth(SensorView(OneBoard(0.8), camera, model), model, camera, 1, 0);
  const double blind = camera.fx * 0.05015 / 0.8 - 0.5;
  for (int u = 0; u < 80; ++u) EXPECT_EQ(z(240, u) > 0, u >= blind) << u;
  // An imager on the other side is blind on the other side.
  model.baseline_m = -0.05015;
  const cv::Mat1d other =
      MeasureDepth(SensorView(OneBoard(0.8), camera, model), model, camera, 1, 0);
  for (int u = 0; u < 80; ++u) {
    EXPECT_GT(other(240, u), 0) << u;
    EXPECT_EQ(other(240, camera.width - 1 - u) > 0, u >= blind) << u;
  }
}

// As with a projector: f B (1/z_near - 1/z_far) pixels left of the near thing.
TEST(RightImagersShadow, HasTheWidthThatTheBaselineGives) {
  D435Model model = D435AllOff();
  model.baseline_m = 0.05015;
  const double z_near = 0.8, z_far = 1.6;
  const Camera camera;
  const Rendering rendering = SensorView(BoardBeforeWall(z_near, z_far), camera, model);
  const cv::Mat1d z = MeasureDepth(rendering, model, camera, 1, 0);
  int width = 0;
  for (int u = 60; u < camera.width; ++u) {
    if (z(240, u) > 0) continue;
    ++width;
    EXPECT_LT(u, camera.cx);
  }
  EXPECT_NEAR(width, camera.fx * 0.05015 * (1 / z_near - 1 / z_far), 1.01);
}

TEST(NearThings, GrowByThreePixelsOnEverySide) {
  D435Model model = D435AllOff();
  model.fattening_px = 3;
  const Camera camera;
  const Rendering rendering = SensorView(BoardBeforeWall(0.8, 1.6), camera, model);
  const cv::Mat1d z = MeasureDepth(rendering, model, camera, 1, 0);
  const auto extent = [](const cv::Mat1d& depth, bool across) {
    int count = 0;
    for (int i = 0; i < (across ? depth.cols : depth.rows); ++i) {
      if (std::abs((across ? depth(240, i) : depth(i, 320)) - 0.8) < 1e-6) ++count;
    }
    return count;
  };
  EXPECT_EQ(extent(z, true), extent(rendering.depth_m, true) + 6);
  EXPECT_EQ(extent(z, false), extent(rendering.depth_m, false) + 6);
}

TEST(NearThings, DoNotGrowOverWhatIsAlmostAsNear) {
  D435Model model = D435AllOff();
  model.fattening_px = 3;
  const Camera camera;  // 2 cm at 1 m: 0.42 px of disparity
  const Rendering rendering = SensorView(BoardBeforeWall(1.0, 1.02), camera, model);
  const cv::Mat1d z = MeasureDepth(rendering, model, camera, 1, 0);
  EXPECT_EQ(cv::countNonZero(z != rendering.depth_m), 0);
}

// In a 7 x 7 window whose middle column borders on the edge the surfaces have 4 and 3 columns:
// 57 %, refused. One column further it is 5 to 2: 71 %, kept.
TEST(WindowsOnAnEdge, AreRefusedOnePixelEitherSide) {
  D435Model model = D435AllOff();
  model.min_share = 0.6;
  const Camera camera;
  const Rendering rendering = SensorView(BoardBeforeWall(0.8, 1.6), camera, model);
  const cv::Mat1d z = MeasureDepth(rendering, model, camera, 1, 0);
  int first = 200;
  while (rendering.object_id(240, first) != 2) ++first;
  for (int u = first - 6; u < first + 6; ++u) {
    EXPECT_EQ(z(240, u) > 0, u != first && u != first - 1) << u - first;
  }
}

// A window sees two surfaces where the fattened edge is, on either side of it alike.
TEST(WindowsOnAnEdge, AreRefusedAboutItsFattenedPlace) {
  const Camera camera;
  D435Model model = D435AllOff();
  model.fattening_px = 3;
  model.window_px = 7;
  model.min_share = 0.8;
  const Rendering rendering = SensorView(BoardBeforeWall(1, 2), camera, model);
  const int v = camera.height / 2;
  int edge = 0;  // the board's first column
  while (rendering.object_id(v, edge) != 2) ++edge;
  const cv::Mat1d z = MeasureDepth(rendering, model, camera, 3, 0);
  for (int u = edge - 10; u < edge + 10; ++u) {
    // Of a window k pixels from the edge, (4 + k) of 7 columns show the own surface.
    const int fattened = edge - model.fattening_px;
    const bool lost = u >= fattened - 2 && u < fattened + 2;
    EXPECT_NEAR(z(v, u), lost ? 0.0 : u < fattened ? 2.0 : 1.0, 1e-9) << u - edge;
  }
}

}  // namespace
}  // namespace sim
