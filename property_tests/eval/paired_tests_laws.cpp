#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "eval/regression/paired_tests.h"

namespace eval {
namespace {

/// Differences with ties and zeros among them.
std::vector<double> AnyDifferences() {
  const std::vector<int> steps =
      *rc::gen::resize(12, rc::gen::container<std::vector<int>>(rc::gen::inRange(-6, 7)));
  std::vector<double> differences;
  for (const int step : steps) differences.push_back(0.25 * step);
  return differences;
}

std::vector<double> Negated(std::vector<double> values) {
  for (double& value : values) value = -value;
  return values;
}

/// P(T >= t) + P(T >= -t) counts every sum once, and those equal to |t| once more.
RC_GTEST_PROP(PairedTestsLaws, SignFlipIsSymmetric, ()) {
  const std::vector<double> differences = AnyDifferences();
  const double worse = SignFlipP(differences), better = SignFlipP(Negated(differences));
  const auto one = std::ldexp(1.0, -static_cast<int>(differences.size()));
  RC_ASSERT(worse + better >= 1.0 + one - 1e-12);
  RC_ASSERT(worse >= one - 1e-15 && worse <= 1.0);
}

RC_GTEST_PROP(PairedTestsLaws, WilcoxonIsSymmetric, ()) {
  const std::vector<double> differences = AnyDifferences();
  const SignedRanks ranks = RankDifferences(differences);
  const SignedRanks turned = RankDifferences(Negated(differences));
  RC_ASSERT(ranks.plus == turned.minus && ranks.minus == turned.plus);
  RC_ASSERT(WilcoxonExactP(differences) + WilcoxonExactP(Negated(differences)) >= 1.0 - 1e-12);
}

RC_GTEST_PROP(PairedTestsLaws, OrderOfPairsChangesNothing, ()) {
  const std::vector<double> differences = AnyDifferences();
  std::vector<double> shuffled = differences;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(*rc::gen::inRange(0u, 1000u)));
  RC_ASSERT(std::abs(SignFlipP(shuffled) - SignFlipP(differences)) < 1e-12);
  RC_ASSERT(std::abs(WilcoxonExactP(shuffled) - WilcoxonExactP(differences)) < 1e-12);
  RC_ASSERT(HodgesLehmannShift(shuffled) == HodgesLehmannShift(differences));
}

RC_GTEST_PROP(PairedTestsLaws, AShiftIsFound, ()) {
  std::vector<double> differences = AnyDifferences();
  const double before = HodgesLehmannShift(differences);
  for (double& difference : differences) difference += 2.0;
  RC_ASSERT(differences.empty() || HodgesLehmannShift(differences) == before + 2.0);
}

RC_GTEST_PROP(PairedTestsLaws, HolmIsMonotone, ()) {
  const auto steps = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 101));
  std::vector<double> p;
  for (const int step : steps) p.push_back(0.01 * step);
  const std::vector<double> adjusted = HolmAdjusted(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    RC_ASSERT(adjusted[i] >= p[i] && adjusted[i] <= 1.0);
    for (std::size_t j = 0; j < p.size(); ++j) {
      RC_ASSERT(p[i] > p[j] || adjusted[i] <= adjusted[j]);
    }
  }
}

}  // namespace
}  // namespace eval
