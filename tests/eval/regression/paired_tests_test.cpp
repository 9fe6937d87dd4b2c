#include "eval/regression/paired_tests.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>

#include "tests/support/shared_data.h"

namespace eval {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

constexpr double kGoldenTolerance = 1e-9;

/// The reference figures of scipy.
class GoldenPairs : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto file = test_support::SharedFolder() / "golden/paired_statistics.json";
    SKIP_WITHOUT(file);
    golden_ = nlohmann::json::parse(std::ifstream(file));
  }
  static std::vector<double> Differences(const nlohmann::json& one) {
    const std::vector<double> before = one.at("baseline"), now = one.at("candidate");
    std::vector<double> differences(now.size());
    std::transform(now.begin(), now.end(), before.begin(), differences.begin(), std::minus<>());
    return differences;
  }
  static std::vector<double> LogRatios(const nlohmann::json& one) {
    const std::vector<double> before = one.at("baseline"), now = one.at("candidate");
    std::vector<double> ratios(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) ratios[i] = std::log(now[i] / before[i]);
    return ratios;
  }
  void TearDown() override {
    for (const auto& [name, count] : compared_) EXPECT_GT(count, 0) << "no case has " << name;
  }
  /// Compares with the figure of that name, if the case has one; some case must.
  void Expect(const nlohmann::json& one, const char* name, double ours) {
    int& count = compared_[name];
    if (!one.contains(name)) return;
    ++count;
    EXPECT_NEAR(ours, one.at(name).get<double>(), kGoldenTolerance) << one.at("name") << name;
  }
  const nlohmann::json* Named(const std::string& name) const {
    for (const nlohmann::json& one : golden_.at("paired")) {
      if (one.at("name") == name) return &one;
    }
    return nullptr;
  }

  nlohmann::json golden_;
  std::map<std::string, int> compared_;  ///< cases, by figure
};

TEST_F(GoldenPairs, SignedRanksAreThoseOfScipy) {
  for (const nlohmann::json& one : golden_.at("paired")) {
    const std::vector<double> differences = Differences(one);
    const SignedRanks ranks = RankDifferences(differences);
    Expect(one, "W_plus", ranks.plus);
    Expect(one, "W_minus", ranks.minus);
    Expect(one, "n_nonzero", static_cast<double>(ranks.ranks.size()));
    Expect(one, "wilcoxon_exact|greater", WilcoxonExactP(differences));
    Expect(one, "wilcoxon_approx|greater|cc", WilcoxonNormalP(differences, true));
    Expect(one, "wilcoxon_approx|greater|nocc", WilcoxonNormalP(differences, false));
  }
}

// A test of both sides at once is twice the smaller of two tests of one side.
TEST_F(GoldenPairs, TestsOfBothSidesAreTwiceTheSmallerOfTwo) {
  const auto two_sided = [](const std::vector<double>& differences, const auto& test) {
    std::vector<double> mirrored = differences;
    for (double& d : mirrored) d = -d;
    return std::min(1.0, 2.0 * std::min(test(differences), test(mirrored)));
  };
  const auto normal = [](bool continuity) {
    return [=](const std::vector<double>& d) { return WilcoxonNormalP(d, continuity); };
  };
  const auto exact = [](const std::vector<double>& d) { return WilcoxonExactP(d); };
  const auto flip = [](const std::vector<double>& d) { return SignFlipP(d); };
  for (const nlohmann::json& one : golden_.at("paired")) {
    const std::vector<double> d = Differences(one);
    Expect(one, "wilcoxon_exact|two-sided", two_sided(d, exact));
    Expect(one, "wilcoxon_approx|two-sided|cc", two_sided(d, normal(true)));
    Expect(one, "wilcoxon_approx|two-sided|nocc", two_sided(d, normal(false)));
    if (one.contains("signflip_exact_mean|two-sided"))
      Expect(one, "signflip_exact_mean|two-sided", two_sided(d, flip));
  }
}

// Of signs alone, flips are the sign test.
TEST_F(GoldenPairs, FlippedSignsAloneAreTheSignTest) {
  for (const nlohmann::json& one : golden_.at("paired")) {
    std::vector<double> signs;
    for (const double d : Differences(one)) {
      if (d != 0.0) signs.push_back(d > 0.0 ? 1.0 : -1.0);
    }
    if (signs.size() <= kMaxSignFlipPairs) Expect(one, "sign_test|greater", SignFlipP(signs));
  }
}

TEST_F(GoldenPairs, SignFlipsAreThoseOfTheReference) {
  for (const nlohmann::json& one : golden_.at("paired")) {
    if (!one.contains("signflip_exact_mean|greater")) continue;
    Expect(one, "signflip_exact_mean|greater", SignFlipP(Differences(one)));
  }
}

TEST_F(GoldenPairs, ShiftsAreThoseOfTheReference) {
  for (const nlohmann::json& one : golden_.at("paired")) {
    Expect(one, "hodges_lehmann_paired", HodgesLehmannShift(Differences(one)));
    const std::vector<double> ratios = LogRatios(one);
    const double mean =
        std::accumulate(ratios.begin(), ratios.end(), 0.0) / static_cast<double>(ratios.size());
    Expect(one, "geomean_ratio", std::exp(mean));
  }
}

// The reference's table of indices, on pairs that its file has: the intervals are those of Python's
// statistics.quantiles(method="inclusive").
TEST_F(GoldenPairs, BootstrapIntervalsAreThoseOfPythonsQuantiles) {
  const nlohmann::json* pairs = Named("lognormal_n15_s0.2");
  ASSERT_NE(pairs, nullptr);
  std::vector<double> ratios = LogRatios(*pairs);
  ratios.resize(12);
  const std::vector<std::vector<std::size_t>> indices = golden_.at("bootstrap").at("indices");
  const ConfidenceInterval wide = BootstrapMeanInterval(ratios, indices, 0.95);
  EXPECT_NEAR(wide.low, -0.01718688234451963, kGoldenTolerance);
  EXPECT_NEAR(wide.high, 0.162301497621634, kGoldenTolerance);
  const ConfidenceInterval narrow = BootstrapMeanInterval(ratios, indices, 0.90);
  EXPECT_NEAR(narrow.low, -0.0021030718754649295, kGoldenTolerance);
  EXPECT_NEAR(narrow.high, 0.14478648467790087, kGoldenTolerance);
}

TEST_F(GoldenPairs, HolmIsThatOfTheReference) {
  const nlohmann::json& many = golden_.at("multiple_testing");
  const std::vector<double> p = many.at("p_sorted"), theirs = many.at("holm_adjusted");
  EXPECT_THAT(HolmAdjusted(p), Pointwise(DoubleNear(kGoldenTolerance), theirs));
}

TEST(PairedTests, NothingIsNoEvidence) {
  EXPECT_EQ(SignFlipP({}), 1.0);
  EXPECT_EQ(WilcoxonExactP({}), 1.0);
  EXPECT_EQ(WilcoxonNormalP({}, true), 1.0);
  EXPECT_EQ(HodgesLehmannShift({}), 0.0);
  EXPECT_THAT(HolmAdjusted({}), ::testing::IsEmpty());
}

TEST(PairedTests, EqualPairsAreNoEvidence) {
  const std::vector<double> zeros(12, 0.0);
  EXPECT_EQ(SignFlipP(zeros), 1.0);
  EXPECT_EQ(WilcoxonExactP(zeros), 1.0);
  EXPECT_EQ(HodgesLehmannShift(zeros), 0.0);
}

// Three pairs, all worse: only one of eight assignments of signs is as bad.
TEST(PairedTests, SignFlipsOfThreePairsByHand) {
  const std::vector<double> worse{1.0, 2.0, 3.0};
  EXPECT_DOUBLE_EQ(SignFlipP(worse), 1.0 / 8);
  const std::vector<double> mixed{1.0, 2.0, -3.0};  // sums 0 or more: 6, 4, 2, 0 and 0
  EXPECT_DOUBLE_EQ(SignFlipP(mixed), 5.0 / 8);
}

// |d| of 1, 1 and 2 have the ranks 1.5, 1.5 and 3; a plus sum of 4.5 or more comes with 4.5 (twice)
// and 6.
TEST(PairedTests, TiedRanksByHand) {
  const std::vector<double> tied{1.0, -1.0, 2.0};
  EXPECT_DOUBLE_EQ(RankDifferences(tied).plus, 4.5);
  EXPECT_DOUBLE_EQ(WilcoxonExactP(tied), 3.0 / 8);
}

// Means of the five resamples are 0, 1, 2, 3 and 4: the quantiles 0.1 and 0.9 of five sorted
// values lie 0.4 of the way into the first and the last gap.
TEST(PairedTests, BootstrapIntervalByHand) {
  const std::vector<double> values{0.0, 4.0};
  const std::vector<std::vector<std::size_t>> resamples{
      {1, 1, 1, 1}, {0, 0, 0, 0}, {0, 0, 1, 1}, {1, 0, 0, 0}, {1, 1, 0, 1}};
  const ConfidenceInterval interval = BootstrapMeanInterval(values, resamples, 0.8);
  EXPECT_DOUBLE_EQ(interval.low, 0.4);
  EXPECT_DOUBLE_EQ(interval.high, 3.6);
}

TEST(PairedTests, RefusesSignFlipsWithoutEnd) {
  EXPECT_THROW(SignFlipP(std::vector<double>(21, 1.0)), std::invalid_argument);
}

TEST(PairedTests, ResamplesAreTheSameEachTime) {
  EXPECT_EQ(DrawResamples(9, 50), DrawResamples(9, 50));
}

}  // namespace
}  // namespace eval
