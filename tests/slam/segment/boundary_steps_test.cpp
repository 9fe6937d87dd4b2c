#include "slam/segment/boundary_steps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/geometry/camera.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// Two surfaces that meet in the middle column: depth 1 m on the left; on the right it begins
/// `step_m` farther and grows with `slope` metres a unit of x/z.
struct TwoSides {
  TwoSides(double step_m, double slope, std::uint64_t noise_seed = 0) {
    const Camera camera;
    const cv::Mat2d rays = PixelRays(camera);
    cv::Mat1f depth_m(camera.height, camera.width);
    labels.resize(depth_m.total());
    for (int v = 0; v < depth_m.rows; ++v) {
      for (int u = 0; u < depth_m.cols; ++u) {
        const double x = rays(v, u)[0] - rays(0, depth_m.cols / 2)[0];
        const bool right = u >= depth_m.cols / 2;
        depth_m(v, u) = static_cast<float>(right ? 1.0 + step_m + slope * x : 1.0);
        labels[static_cast<std::size_t>(v * depth_m.cols + u)] = right ? 1 : 0;
      }
    }
    if (noise_seed > 0) depth_m = closed_form::AddKinectNoise(depth_m, noise_seed);
    grid = MakeDepthGrid(depth_m, rays, noise, 10.0);
    const std::vector<PlaneSums> sums = SumLabels(grid, labels, 2);
    for (const PlaneSums& side : sums) planes.push_back({Fit(side)->plane, 1.0});
  }
  BoundaryStep Step() const {
    LabelRuns runs;
    FindRuns(labels, grid.width, grid.height, runs);
    BoundarySteps steps;
    StepMeasurement().Measure(grid, labels, runs, planes, steps);
    return steps.Of(0, 1);
  }
  double MeanSquare() const { return Step().MeanSquare(noise.correlated_px); }
  /// Of a step, in sigmas of a pixel.
  double Sigmas(double step_m) const { return step_m / noise.Sigma(1.0); }

  DepthNoise noise;
  DepthGrid grid;
  LabelImage labels;
  std::vector<LabelPlane> planes;
};

TEST(BoundarySteps, AreTheStepInSigmasOfAPixelWhateverTheSlope) {
  for (const double slope : {0.0, 0.1, -0.1}) {
    const TwoSides sides(0.020, slope);
    const BoundaryStep step = sides.Step();
    // The slope's curvature over 10 pixels and sigma's own growth: a tenth.
    EXPECT_NEAR(std::sqrt(step.squares / step.pairs), sides.Sigmas(0.020),
                0.1 * sides.Sigmas(0.020));
  }
}

TEST(BoundarySteps, AreNoneAtACrease) {
  for (const double slope : {0.05, 0.2, -0.2}) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      EXPECT_LT(TwoSides(0.0, slope, seed).MeanSquare(), 0.5) << slope << " seed " << seed;
    }
  }
}

TEST(BoundarySteps, OfFiveMillimetresStandOutOfTheNoise) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const TwoSides sides(0.005, 0.0, seed);
    const double square = sides.Sigmas(0.005) * sides.Sigmas(0.005);
    EXPECT_NEAR(sides.MeanSquare(), square, 0.35 * square) << "seed " << seed;
  }
}

TEST(BoundarySteps, OfOppositeSignsDoNotCancel) {
  TwoSides sides(0.0, 0.0);
  const int width = sides.grid.width, height = sides.grid.height;
  for (int v = 0; v < height; ++v) {
    for (int u = width / 2; u < width; ++u) {
      sides.grid.q[static_cast<std::size_t>(v * width + u)] = v < height / 2 ? 1.02f : 0.98f;
    }
  }
  EXPECT_GT(sides.MeanSquare(), 0.8 * sides.Sigmas(0.02) * sides.Sigmas(0.02));
}

}  // namespace
}  // namespace slam
