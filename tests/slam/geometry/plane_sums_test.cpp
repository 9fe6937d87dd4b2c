#include "slam/geometry/plane_sums.h"

#include <gtest/gtest.h>

namespace slam {
namespace {

// A wall that is faced: n pixels know its depth sqrt(n) times as well as one, near and far.
TEST(PlaneSigmas, OfAWallAreThoseOfTheMeanOfItsDepths) {
  DepthNoise noise;
  noise.correlated_px = 4.0;
  constexpr double kScale = 1.5;
  for (const double z_m : {0.5, 1.0, 3.0}) {
    const double sigma_m = noise.Sigma(z_m);
    const double weight = std::pow(z_m * z_m / sigma_m, 2);
    PlaneSums sums;
    double spread2 = 0.0;
    for (int v = -10; v <= 10; ++v) {
      for (int u = -10; u <= 10; ++u) {
        sums.Add(0.1 + 0.02 * u, -0.2 + 0.02 * v, 1 / z_m, weight);
        spread2 += std::pow(0.02 * u * z_m, 2);
      }
    }
    const PlaneSigmas found = Sigmas(sums, {0, 0, 1 / z_m}, noise, kScale);
    const double pixel_m = kScale * std::sqrt(noise.correlated_px) * sigma_m;
    EXPECT_NEAR(found.offset_m, pixel_m / 21, 1e-9) << z_m;
    // A line through points that are spread so far.
    EXPECT_NEAR(found.angle_rad, pixel_m / std::sqrt(spread2), 1e-9) << z_m;
  }
}

}  // namespace
}  // namespace slam
