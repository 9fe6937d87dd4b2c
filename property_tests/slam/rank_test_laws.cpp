#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "property_tests/generators/poses.h"
#include "slam/associate/rank_test.h"

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

}  // namespace
}  // namespace slam
