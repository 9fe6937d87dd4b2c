#include "sim/sensor/noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sim {
namespace {

TEST(NormalQuantile, InvertsTheErrorFunctionOfTheLibrary) {
  constexpr double kStatedRelativeError = 2e-9;
  for (double x = -6.0; x <= 6.0; x += 0.037) {
    const double p = 0.5 * std::erfc(-x / std::sqrt(2.0));
    // Above one half p keeps few digits of its distance to 1: compare by the smaller tail.
    if (x < 3.0) {
      EXPECT_NEAR(NormalQuantile(p), x, kStatedRelativeError * std::max(1.0, std::abs(x)));
    }
  }
}

TEST(NormalProbability, StaysWithinItsStatedError) {
  for (double x = -8.0; x <= 8.0; x += 0.05) {
    EXPECT_NEAR(NormalProbability(x), 0.5 * std::erfc(-x / std::sqrt(2.0)), 1e-7);
  }
}

// Four draws come from one set of bits; neighbours must not tell on each other either.
TEST(PixelNoise, HasDrawsThatTellNothingOfEachOther) {
  const PixelNoise noise(3, 8);
  constexpr int kSide = 300;
  for (std::uint32_t a = 0; a < 5; ++a) {
    for (std::uint32_t b = 0; b < 5; ++b) {
      double here = 0, beside = 0;
      for (int v = 0; v < kSide; ++v) {
        for (int u = 0; u < kSide; ++u) {
          const double x = noise.Normal(u, v, a);
          here += x * noise.Normal(u, v, b);
          beside += x * noise.Normal(u + 1, v, b);
        }
      }
      constexpr double kFourSd = 4.0 / kSide;
      EXPECT_NEAR(here / (kSide * kSide), a == b ? 1.0 : 0.0, kFourSd * (a == b ? 1.5 : 1.0));
      EXPECT_NEAR(beside / (kSide * kSide), 0.0, kFourSd);
    }
  }
}

TEST(PixelNoise, HasTheTailsOfANormal) {
  const PixelNoise noise(4, 9);
  constexpr int kSide = 600;
  int beyond_2 = 0, beyond_3 = 0;
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      const double x = std::abs(noise.Normal(u, v, 2));
      beyond_2 += x > 2 ? 1 : 0;
      beyond_3 += x > 3 ? 1 : 0;
    }
  }
  EXPECT_NEAR(beyond_2 / 360000.0, 0.04550, 0.0015);
  EXPECT_NEAR(beyond_3 / 360000.0, 0.00270, 0.0004);
}

TEST(PixelNoise, HasUnitVarianceAndNoMean) {
  const PixelNoise noise(7, 3);
  constexpr int kSide = 400;
  constexpr double kCount = kSide * kSide;
  double sum = 0, squares = 0, across = 0;
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      const double x = noise.Normal(u, v, 0);
      sum += x;
      squares += x * x;
      across += x * noise.Normal(u + 1, v, 0);
    }
  }
  // Five standard errors: false alarm 6e-7 each, and the seed is fixed.
  EXPECT_NEAR(sum / kCount, 0, 5 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1, 5 * std::sqrt(2 / kCount));
  EXPECT_NEAR(across / kCount, 0, 5 / std::sqrt(kCount));
}

}  // namespace
}  // namespace sim
