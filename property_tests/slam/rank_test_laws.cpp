#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "property_tests/generators/poses.h"
#include "slam/associate/rank_test.h"
#include "slam/base/random.h"
#include "tests/support/normal_draws.h"

namespace slam {
namespace {

std::vector<double> AnySample(int low, int high) {
  std::vector<double> sample(static_cast<std::size_t>(AnyInt(low, high)));
  for (double& v : sample) v = AnyInt(0, 10);  // many ties
  return sample;
}

RC_GTEST_PROP(RankTestEq9, BothStatisticsAddUpToTheNumberOfPairs, ()) {
  const auto x = AnySample(1, 40), y = AnySample(1, 40);
  const RankTest test = TestRanks(x, y);
  RC_ASSERT(test.U_c + test.U_w == static_cast<double>(x.size() * y.size()));
  double pairs = 0;  // U is the number of pairs in which x is greater, ties for a half
  for (const double a : x) {
    for (const double b : y) pairs += a > b ? 1 : a == b ? 0.5 : 0;
  }
  RC_ASSERT(test.U_c == pairs);
}

RC_GTEST_PROP(RankTestEq12, IsSymmetricAndBlindToOrderAndMonotoneMaps, ()) {
  auto x = AnySample(1, 40), y = AnySample(1, 40);
  const double p = TestRanks(x, y).p;
  RC_ASSERT(p >= 0 && p <= 1);
  RC_ASSERT(TestRanks(y, x).p == p);
  std::reverse(x.begin(), x.end());
  std::sort(y.begin(), y.end());
  RC_ASSERT(TestRanks(x, y).p == p);
  for (auto* sample : {&x, &y}) {
    for (double& v : *sample) v = v * v * v + 17;
  }
  RC_ASSERT(TestRanks(x, y).p == p);
}

/// Share of all divisions of the pooled values whose U is as far from its mean, by brute force.
double Enumerated(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> pooled = x;
  pooled.insert(pooled.end(), y.begin(), y.end());
  const auto distance = [&](const std::vector<int>& chosen) {
    double u = 0;
    for (std::size_t i = 0; i < pooled.size(); ++i) {
      for (std::size_t k = 0; k < pooled.size(); ++k) {
        if (!chosen[i] || chosen[k]) continue;
        u += pooled[i] > pooled[k] ? 1 : pooled[i] == pooled[k] ? 0.5 : 0;
      }
    }
    return std::abs(u - 0.5 * static_cast<double>(x.size() * y.size()));
  };
  std::vector<int> chosen(pooled.size(), 0);
  std::fill(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(x.size()), 1);
  const double seen = distance(chosen);
  double all = 0, extreme = 0;
  do {
    ++all;
    extreme += distance(chosen) >= seen ? 1 : 0;
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return extreme / all;
}

RC_GTEST_PROP(RankTestEq12, EqualsTheEnumerationOfSmallSamples, ()) {
  const auto x = AnySample(1, 5), y = AnySample(1, 6);
  const RankTest test = TestRanks(x, y);
  RC_ASSERT(test.exact);
  RC_ASSERT(std::abs(test.p - Enumerated(x, y)) < 1e-12);
}

RC_GTEST_PROP(PlaneRankTest, DoesNotDependOnHowTheWorldIsTurned, ()) {
  std::vector<Eigen::Vector3d> a, b;
  for (int i = 0; i < 15; ++i) {
    a.emplace_back(AnyReal(-0.2, 0.2), AnyReal(-0.1, 0.1), AnyReal(-0.002, 0.002));
    b.emplace_back(AnyReal(-0.2, 0.2), AnyReal(-0.1, 0.1), AnyReal(-0.002, 0.002));
  }
  const Plane pi{Eigen::Vector3d::UnitZ(), 0};
  const double here = TestPlaneRanks(a, b, PlaneAxes(pi, b), 6).value();
  const Pose T_vw = AnyPose(5);
  for (auto* cloud : {&a, &b}) {
    for (Eigen::Vector3d& p : *cloud) p = T_vw * p;
  }
  const double there = TestPlaneRanks(a, b, PlaneAxes(Transform(T_vw, pi), b), 6).value();
  RC_ASSERT(std::abs(here - there) < 1e-9);
}

/// How many orders of n and m values have each U, by Mann and Whitney's recurrence: the largest
/// value is of the one sample, above all m of the other, or of the other.
std::vector<double> OrdersByU(int n, int m) {
  if (n == 0 || m == 0) return {1.0};
  std::vector<double> orders(static_cast<std::size_t>(n * m + 1), 0.0);
  const auto above = OrdersByU(n - 1, m), below = OrdersByU(n, m - 1);
  for (std::size_t u = 0; u < above.size(); ++u)
    orders[u + static_cast<std::size_t>(m)] += above[u];
  for (std::size_t u = 0; u < below.size(); ++u) orders[u] += below[u];
  return orders;
}

/// The same for sizes that recursion alone would never finish.
std::vector<double> OrdersByUInTable(int n, int m) {
  std::vector<std::vector<double>> row;  // [k]: of k and j values, j rising
  for (int k = 0; k <= n; ++k) row.push_back({1.0});
  for (int j = 1; j <= m; ++j) {
    for (int k = 1; k <= n; ++k) {
      const auto& above = row[static_cast<std::size_t>(k - 1)];  // of j already
      auto& here = row[static_cast<std::size_t>(k)];             // of j - 1 still
      here.resize(static_cast<std::size_t>(k * j + 1), 0.0);
      for (std::size_t u = 0; u < above.size(); ++u)
        here[u + static_cast<std::size_t>(j)] += above[u];
    }
  }
  return row.back();
}

double TwoSided(const std::vector<double>& orders, std::size_t u, double mean) {
  const double far = std::abs(static_cast<double>(u) - mean);
  double all = 0, extreme = 0;
  for (std::size_t k = 0; k < orders.size(); ++k) {
    all += orders[k];
    if (std::abs(static_cast<double>(k) - mean) >= far) extreme += orders[k];
  }
  return extreme / all;
}

/// n values and m values, all different, of which `u` pairs have the first greater.
std::array<std::vector<double>, 2> SamplesOf(int n, int m, int u) {
  std::array<std::vector<double>, 2> samples;
  for (int j = 1; j <= m; ++j) samples[1].push_back(j);
  for (int i = 0; i < n; ++i) {
    const int beaten = std::min(u, m);  // of the other sample
    u -= beaten;
    samples[0].push_back(beaten + 0.5 + 0.01 * i);
  }
  return samples;
}

TEST(RankTestEq12, EqualsTheExactDistributionForEveryUAndAllSizesToEight) {
  for (int n = 1; n <= 8; ++n) {
    for (int m = 1; m <= 8; ++m) {
      const auto orders = OrdersByU(n, m);
      for (int u = 0; u <= n * m; ++u) {
        const auto [x, y] = SamplesOf(n, m, u);
        const RankTest test = TestRanks(x, y);
        ASSERT_EQ(test.U_c, u);
        ASSERT_TRUE(test.exact) << n << " and " << m;
        const double expected = TwoSided(orders, static_cast<std::size_t>(u), 0.5 * n * m);
        ASSERT_NEAR(test.p, expected, 1e-12) << n << " and " << m << ", U " << u;
        EXPECT_TRUE(n > 3 || m > 3 || test.p > 0.1 - 1e-12);
      }
    }
  }
}

// Without the continuity correction 0.034 and 0.0076 are reached.
TEST(RankTestEq12, IsNearTheExactDistributionForEveryUOfLargerSamples) {
  ASSERT_EQ(OrdersByUInTable(5, 7), OrdersByU(5, 7));
  for (const auto& [size, bound] : {std::pair(10, 0.01), std::pair(30, 0.003)}) {
    const auto orders = OrdersByUInTable(size, size);
    double worst = 0;
    for (int u = 0; u <= size * size; ++u) {
      const auto [x, y] = SamplesOf(size, size, u);
      const RankTest test = TestRanks(x, y);
      ASSERT_EQ(test.U_c, u);
      const double exact = TwoSided(orders, static_cast<std::size_t>(u), 0.5 * size * size);
      worst = std::max(worst, std::abs(test.p - exact));
    }
    EXPECT_LT(worst, bound) << size;
  }
}

constexpr int kRankTrials = 20000;
constexpr double kRankAlpha = 0.05;
/// Five standard deviations of a binomial: 0.0077.
double RankBand(double rate) { return 5 * std::sqrt(rate * (1 - rate) / kRankTrials); }

/// Stationary, each value `rho` of the one before and as much of its own as keeps the variance.
std::vector<double> DrawChain(int count, double rho, Random& random) {
  std::vector<double> chain{Normal(random)};
  while (static_cast<int>(chain.size()) < count)
    chain.push_back(rho * chain.back() + std::sqrt(1 - rho * rho) * Normal(random));
  return chain;
}

/// Share of trials that reject two samples of one distribution, every `step`-th value of a chain.
double RejectionRate(double rho, int step) {
  constexpr int kSize = 30;
  int rejected = 0;
  for (int trial = 0; trial < kRankTrials; ++trial) {
    Random random{31, static_cast<std::uint64_t>(trial)};
    std::array<std::vector<double>, 2> samples;
    for (auto& sample : samples) {
      const auto chain = DrawChain(kSize * step, rho, random);
      for (std::size_t i = 0; i < chain.size(); i += static_cast<std::size_t>(step))
        sample.push_back(chain[i]);
    }
    rejected += TestRanks(samples[0], samples[1]).p < kRankAlpha ? 1 : 0;
  }
  return static_cast<double>(rejected) / kRankTrials;
}

TEST(RankTestEq12, RejectsOneDistributionAsOftenAsItSaysIfValuesAreIndependent) {
  EXPECT_NEAR(RejectionRate(0.0, 1), kRankAlpha, RankBand(kRankAlpha));
  // Values that go on from each other it rejects at six times the rate; a tenth of them not.
  EXPECT_NEAR(RejectionRate(0.6, 1), 0.316, RankBand(0.316));
  EXPECT_NEAR(RejectionRate(0.6, 10), kRankAlpha, RankBand(kRankAlpha));
}

// The three tests of two clouds together: 1 - (1 - alpha / 3)^3 = 0.0492.
TEST(PlaneRankTest, RejectsPointsOfOneSurfaceAsOftenAsItSays) {
  constexpr int kPoints = 30;
  const Plane pi{Eigen::Vector3d(0.3, -0.5, 0.8).normalized(), 0.4};
  const Eigen::Matrix<double, 3, 2> E = TangentBasis(pi.n);
  int rejected = 0;
  for (int trial = 0; trial < kRankTrials; ++trial) {
    Random random{32, static_cast<std::uint64_t>(trial)};
    std::array<std::vector<Eigen::Vector3d>, 2> clouds;
    for (auto& cloud : clouds) {
      for (int i = 0; i < kPoints; ++i) {
        const double a = random.Uniform(), b = random.Uniform(), off = 0.002 * Normal(random);
        cloud.emplace_back(0.6 * a * E.col(0) + 0.2 * b * E.col(1) + (off - pi.d) * pi.n);
      }
    }
    const auto p = TestPlaneRanks(clouds[0], clouds[1], PlaneAxes(pi, clouds[1]), 6);
    rejected += p.value() < kRankAlpha ? 1 : 0;
  }
  const double rate = 1 - std::pow(1 - kRankAlpha / 3, 3);
  EXPECT_NEAR(static_cast<double>(rejected) / kRankTrials, rate, RankBand(rate));
}

}  // namespace
}  // namespace slam
