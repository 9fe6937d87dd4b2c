#include "slam/segment/joining/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "slam/segment/pixels/block_pixels.h"

namespace slam {
namespace {

using InverseDepthOf = std::function<double(double x, double y)>;

/// Pixels of noise 1 that share nothing.
DepthNoise UnsharedNoise() {
  DepthNoise noise;
  noise.correlated_px = 1.0;
  return noise;
}

/// Sums of a square of `side` rays around (x0, y0), 525 of them a unit, with sd `sigma` of each.
PlaneSums Square(double x0, double y0, int side, const InverseDepthOf& q_of, double sigma,
                 std::mt19937& random) {
  std::normal_distribution<double> noise;
  PlaneSums sums;
  for (int v = 0; v < side; ++v) {
    for (int u = 0; u < side; ++u) {
      const double x = x0 + (u - 0.5 * side) / 525.0, y = y0 + (v - 0.5 * side) / 525.0;
      sums.Add(x, y, q_of(x, y) + sigma * noise(random), 1.0 / (sigma * sigma));
    }
  }
  return sums;
}

double Slanted(double x, double y) { return 1.0 + 0.1 * x - 0.2 * y; }

/// Joining that knows of noise alone.
JoinConfig NoiseAlone() {
  JoinConfig config;
  config.union_gap_sigmas = 0.0, config.bend_ratio = 0.0;
  return config;
}

// The plane for both has 3 parameters where one for each has 6.
TEST(UnionChi2, HasTheMeanAndVarianceOfThreeDegreesOfFreedomForPartsOfOnePlane) {
  std::mt19937 random(1);
  double sum = 0.0, squares = 0.0;
  constexpr int kTrials = 2000;
  for (int k = 0; k < kTrials; ++k) {
    const PlaneSums a = Square(-0.2, 0.0, 20, Slanted, 0.002, random);
    const PlaneSums b = Square(0.3, 0.1, 10, Slanted, 0.002, random);
    const double chi2 = UnionChi2(a, b, UnsharedNoise(), NoiseAlone());
    sum += chi2, squares += chi2 * chi2;
  }
  const double mean = sum / kTrials;
  EXPECT_NEAR(mean, 3.0, 5.0 * std::sqrt(6.0 / kTrials));
  EXPECT_NEAR(squares / kTrials - mean * mean, 6.0, 1.2);
}

TEST(UnionChi2, IsTheSameInEitherOrder) {
  std::mt19937 random(2);
  const PlaneSums a = Square(-0.2, 0.0, 20, Slanted, 0.002, random);
  const PlaneSums b = Square(0.3, 0.1, 10, Slanted, 0.002, random);
  EXPECT_DOUBLE_EQ(UnionChi2(a, b, {}, {}), UnionChi2(b, a, {}, {}));
  EXPECT_DOUBLE_EQ(HiddenUnionCost(a, b, {}, {}), HiddenUnionCost(b, a, {}, {}));
}

TEST(UnionChi2, GrowsWithTheSquareOfTheStep) {
  std::mt19937 random(3);
  const auto stepped = [&](double step) {
    const PlaneSums a = Square(-0.1, 0.0, 60, Slanted, 1e-6, random);
    const PlaneSums b = Square(
        0.1, 0.0, 60, [&](double x, double y) { return Slanted(x, y) + step; }, 1e-6, random);
    return UnionChi2(a, b, UnsharedNoise(), NoiseAlone());
  };
  EXPECT_NEAR(stepped(2e-4) / stepped(1e-4), 4.0, 0.01);
}

TEST(UnionChi2, ForgivesWhatTheBendExplains) {
  std::mt19937 random(4);
  const double bend = 0.0033;
  const PlaneSums a = Square(-0.1, 0.0, 60, Slanted, 0.002, random);
  const PlaneSums b = Square(
      0.1, 0.0, 60, [&](double x, double y) { return Slanted(x, y) + 0.5 * bend; }, 0.002,
      random);
  JoinConfig flat = NoiseAlone(), bent = NoiseAlone();
  bent.bend_ratio = bend;
  EXPECT_GT(UnionChi2(a, b, UnsharedNoise(), flat), 100.0);
  EXPECT_LT(UnionChi2(a, b, UnsharedNoise(), bent), 6.0);
}

TEST(UnionChi2, IsInfiniteWithoutAPlane) {
  EXPECT_TRUE(std::isinf(UnionChi2({}, {}, {}, {})));
  EXPECT_TRUE(std::isinf(HiddenUnionCost({}, {}, {}, {})));
}

// Far from a small part its plane tells little, and agreement says as much.
TEST(HiddenUnionCost, RisesWithTheDistanceOverWhichAPlaneIsContinued) {
  std::mt19937 random(5);
  double last = -1e9;
  for (const double apart : {0.1, 0.3, 0.9}) {
    const PlaneSums a = Square(0.0, 0.0, 30, Slanted, 1e-4, random);
    const PlaneSums b = Square(apart, 0.0, 20, Slanted, 1e-4, random);
    const double cost = HiddenUnionCost(a, b, UnsharedNoise(), JoinConfig{});
    EXPECT_GT(cost, last + 1.0) << apart;
    last = cost;
  }
}

// A strip's plane is known along it far better than across.
TEST(HiddenUnionCost, RisesMoreAcrossALongPartThanAlongItHoweverItLies) {
  std::mt19937 random(7);
  for (const bool upright : {false, true}) {
    const auto part = [&](double along, double across, int length) {
      PlaneSums sums;
      std::normal_distribution<double> noise;
      for (int i = 0; i < length; ++i) {
        for (int j = 0; j < 10; ++j) {
          const double a = along + (i - 0.5 * length) / 525.0, b = across + (j - 5.0) / 525.0;
          const double x = upright ? b : a, y = upright ? a : b;
          sums.Add(x, y, Slanted(x, y) + 1e-4 * noise(random), 1e8);
        }
      }
      return sums;
    };
    const PlaneSums strip = part(0.0, 0.0, 200);
    const double along = HiddenUnionCost(strip, part(0.4, 0.0, 20), UnsharedNoise(), {});
    const double across = HiddenUnionCost(strip, part(0.0, 0.4, 20), UnsharedNoise(), {});
    // By the standard deviations there, of which the strip's width makes 20 times as much.
    EXPECT_GT(across, along + 3 * std::log(10.0)) << upright;
  }
}

// The standard deviation at a distance d from the middle of a square of n rays, side s, is
// sigma sqrt((1 + 12 d^2 / s^2) / n), by the moment of inertia of a square.
TEST(HiddenUnionCost, CountsTheSpreadOfTheLargerPlaneAtTheMiddleOfTheSmaller) {
  std::mt19937 random(6);
  const double sigma = 1e-6;  // of noise that leaves no chi-square beside the gap allowed
  JoinConfig config = NoiseAlone();
  config.union_gap_sigmas = 1e3;
  const auto cost = [&](double apart) {
    return HiddenUnionCost(Square(0.0, 0.0, 100, Slanted, sigma, random),
                           Square(apart, 0.0, 40, Slanted, sigma, random), UnsharedNoise(),
                           config);
  };
  const double side = 100.0 / 525.0;
  const auto variance = [&](double d) {
    return 1.0 / 1600.0 + (1.0 + 12.0 * d * d / (side * side)) / 10000.0;
  };
  EXPECT_NEAR(cost(0.5) - cost(0.2), 1.5 * std::log(variance(0.5) / variance(0.2)), 0.01);
}

/// A wall that bends by `ratio`, root mean square, up and down within 0.1.
InverseDepthOf Bent(double ratio) {
  return [ratio](double x, double y) {
    return Slanted(x, y) * (1.0 + ratio * std::sqrt(2.0) * std::sin(20.0 * M_PI * x));
  };
}

TEST(SeenBend, MeasuresWhatLargeSurfacesAreOffTheirPlanesBeyondNoise) {
  std::mt19937 random(7);
  const double sigma = DepthNoise{}.Sigma(1.0);  // of depth, and of inverse depth at 1 m
  for (const double ratio : {0.0, 0.001, 0.003}) {
    const PlaneSums wall = Square(0.0, 0.0, 200, Bent(ratio), sigma, random);
    EXPECT_NEAR(SeenBend({wall}, {}, {}), ratio, 0.0003) << ratio;
  }
}

TEST(SeenBend, BelievesLittleMoreThanTheSensorIsKnownFor) {
  std::mt19937 random(8);
  const JoinConfig config;
  const PlaneSums wall = Square(0.0, 0.0, 200, Bent(0.01), 0.002, random);
  EXPECT_DOUBLE_EQ(SeenBend({wall}, {}, config), config.max_seen_ratio * config.bend_ratio);
  JoinConfig flat;
  flat.bend_ratio = 0.0;
  EXPECT_EQ(SeenBend({wall}, {}, flat), 0.0);
}

// A desk that took in a book is off its plane by more than the sensor bends.
TEST(SeenBend, IsNotMovedByOneSurfaceThatIsTwo) {
  std::mt19937 random(9);
  const double sigma = DepthNoise{}.Sigma(1.0);
  const PlaneSums wall = Square(0.0, 0.0, 200, Bent(0.001), sigma, random);
  const PlaneSums two = Square(
      0.0, 0.0, 150,
      [](double x, double y) { return Slanted(x, y) + (x < 0.0 ? 0.0 : 0.02 * std::abs(y)); },
      sigma, random);
  EXPECT_NEAR(SeenBend({two, wall}, {}, {}), 0.001, 0.0003);
}

TEST(SeenBend, IsTheSensorsWhereNothingIsLarge) {
  std::mt19937 random(10);
  const PlaneSums small = Square(0.0, 0.0, 30, Slanted, 0.002, random);
  EXPECT_EQ(SeenBend({small}, {}, {}), JoinConfig{}.bend_ratio);
  EXPECT_EQ(SeenBend({}, {}, {}), JoinConfig{}.bend_ratio);
}

/// Its normal is 75 degrees off the ray in the middle, where it is 1 m away.
double Steep(double x, double) { return 1.0 + std::tan(75.0 * M_PI / 180.0) * x; }

/// How many times the noise model's noise there is on Steep for the slant.
double SteepNoise() { return DepthNoise{}.GrazingFactor(1.0, std::cos(75.0 * M_PI / 180.0)); }

// Noise grows with the slant, and with it what counts as a sigma; what the sensor bends does not.
TEST(BendSigmas, HoldWhatIsTwoAndAHalfBendsOffTheSurfaceHoweverItIsSlanted) {
  std::mt19937 random(11);
  const DepthNoise noise;
  const JoinConfig config;
  ASSERT_GT(SteepNoise(), 2.0);
  for (const InverseDepthOf& q_of :
       {InverseDepthOf([](double, double) { return 1.0; }), InverseDepthOf(Steep)}) {
    Surface surface;
    surface.sums = Square(0.0, 0.0, 40, q_of, noise.Sigma(1.0), random);
    surface.plane = *FitLabelPlane(surface.sums, noise);
    surface.bent = true;
    for (const double bends : {2.5, 4.0}) {
      DepthGrid pixel;  // in the middle, behind the surface
      const double z_m = 1.0 + bends * config.bend_ratio;
      pixel.width = pixel.height = 1;
      pixel.x = pixel.y = {0.0f};
      pixel.q = {static_cast<float>(1.0 / z_m)};
      pixel.g = {static_cast<float>(z_m * z_m / noise.Sigma(z_m))};
      const float off = std::abs(ResidualSigmas(pixel, 0, PixelPlane(surface.plane)));
      EXPECT_EQ(static_cast<double>(off) < BendSigmas(surface, config), bends < 3.0) << bends;
    }
  }
}

TEST(SeenBend, TakesTheNoiseOfASlantedSurfaceForNoBend) {
  std::mt19937 random(12);
  std::normal_distribution<double> noise;
  const double sigma = DepthNoise{}.Sigma(1.0);
  for (const double ratio : {0.001, 0.003}) {
    const InverseDepthOf noisy = [&](double x, double y) {
      return Steep(x, y) * (1.0 + ratio * std::sqrt(2.0) * std::sin(20.0 * M_PI * x)) +
             sigma * std::sqrt(SteepNoise() * SteepNoise() - 1.0) * noise(random);
    };
    const PlaneSums desk = Square(0.0, 0.0, 200, noisy, sigma, random);
    EXPECT_NEAR(SeenBend({desk}, {}, {}), ratio, 0.0003) << ratio;
  }
}

}  // namespace
}  // namespace slam
