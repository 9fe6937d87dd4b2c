#include "slam/associate/rank_test.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "slam/base/random.h"
#include "tests/support/shared_data.h"

namespace slam {
namespace {

// The reference prints 15 digits; erfc and the survival function agree to a few ulp.
constexpr double kReferenceTolerance = 1e-12;

TEST(RankTestEq9, AgreesWithTheReferenceFigures) {
  const auto path = test_support::SharedFolder() / "golden/mannwhitney.json";
  SKIP_WITHOUT(path);
  const auto cases = nlohmann::json::parse(std::ifstream(path)).at("cases");
  int checked = 0;
  for (const auto& entry : cases) {
    SCOPED_TRACE(entry.at("name").get<std::string>());
    const auto x = entry.at("x").get<std::vector<double>>();
    const auto y = entry.at("y").get<std::vector<double>>();
    if (x.size() > 60 && y.size() < 8) continue;  // thinned by contract
    if (y.size() > 60 && x.size() < 8) continue;
    const RankTest test = TestRanks(x, y);
    EXPECT_DOUBLE_EQ(test.U_c, entry.at("U1").get<double>());
    EXPECT_DOUBLE_EQ(test.U_w, entry.at("U2").get<double>());
    const auto& expected = test.exact ? entry.value("exact_two_sided", nlohmann::json())
                                      : entry.at("p").at("two-sided|cc");
    // The reference's exact p-value knows no ties.
    if (!expected.is_number() || (test.exact && entry.at("has_ties").get<bool>())) continue;
    EXPECT_NEAR(test.p, expected.get<double>(), kReferenceTolerance);
    ++checked;
  }
  EXPECT_GT(checked, 3);
}

TEST(RankTestEq10, DoesNotRejectSamplesOfOneDistributionAsThePrintedMeanDoes) {
  constexpr int kTrials = 2000, kSize = 50;
  constexpr double kAlpha = 0.05;
  int rejected = 0, printed_rejects = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random{10, trial};
    std::vector<double> x(kSize), y(kSize);
    for (double& v : x) v = random.Uniform();
    for (double& v : y) v = random.Uniform();
    const RankTest test = TestRanks(x, y);
    rejected += test.p < kAlpha ? 1 : 0;
    const double I = kSize, J = kSize, W = std::min(test.U_c, test.U_w);
    const double printed_z = (W - I * (I + J + 1) / 2) / std::sqrt(I * J * (I + J + 1) / 12);
    printed_rejects += std::abs(printed_z) > 1.96 ? 1 : 0;
  }
  // Five standard deviations of a binomial: false alarm 6e-7.
  const double band = 5 * std::sqrt(kAlpha * (1 - kAlpha) / kTrials);
  EXPECT_NEAR(static_cast<double>(rejected) / kTrials, kAlpha, band);
  EXPECT_EQ(printed_rejects, kTrials);
}

TEST(RankTestEq11, CountsTiesInTheVariance) {
  // Two values only: by the formula D = I J / 12 (N + 1 - sum (tau^3 - tau) / (N (N - 1))).
  const std::vector<double> x{0, 0, 0, 0, 0, 0, 1, 1, 1, 1}, y{0, 0, 1, 1, 1, 1, 1, 1, 1, 1};
  const double I = 10, J = 10, N = 20, tie = (8 * 8 * 8 - 8) + (12 * 12 * 12 - 12);
  const double D = I * J / 12 * (N + 1 - tie / (N * (N - 1)));
  const RankTest test = TestRanks(x, y);
  const double z = (std::min(test.U_c, test.U_w) - I * J / 2 + 0.5) / std::sqrt(D);
  EXPECT_DOUBLE_EQ(test.p, std::erfc(-z / std::sqrt(2.0)));
}

TEST(RankTestEq12, CannotRejectWithThreeValuesEach) {
  const std::vector<double> low{1, 2, 3}, high{10, 11, 12};
  const RankTest test = TestRanks(low, high);
  EXPECT_TRUE(test.exact);
  EXPECT_DOUBLE_EQ(test.p, 0.1);  // 2 of 20 divisions
}

TEST(RankTestEq12, SaysNothingAboutEqualOrMissingValues) {
  const std::vector<double> same(20, 4.0), none;
  EXPECT_EQ(TestRanks(same, same).p, 1.0);
  EXPECT_EQ(TestRanks(same, none).p, 1.0);
}

TEST(RankTestEq12, ThrowsOnAValueThatIsNotANumber) {
  const std::vector<double> nan{1.0, std::nan("")}, fine{1.0, 2.0};
  EXPECT_THROW(static_cast<void>(TestRanks(nan, fine)), std::invalid_argument);
}

/// Points spread over a rectangle on z = `height`, centred at x.
std::vector<Eigen::Vector3d> Cloud(double x, double height, std::uint64_t key) {
  Random random{key};
  std::vector<Eigen::Vector3d> cloud;
  for (int i = 0; i < 40; ++i) {
    cloud.emplace_back(x + 0.3 * (random.Uniform() - 0.5), 0.2 * (random.Uniform() - 0.5),
                       height + 0.001 * (random.Uniform() - 0.5));
  }
  return cloud;
}

TEST(PlaneRankTest, PassesOneSurfaceAndRefusesOneBesideOrAbove) {
  const auto here = Cloud(0, 0, 1), again = Cloud(0, 0, 2);
  const Eigen::Matrix3d axes = PlaneAxes({Eigen::Vector3d::UnitZ(), 0}, here);
  EXPECT_GT(TestPlaneRanks(again, here, axes, 6).value(), 0.01);
  EXPECT_LT(TestPlaneRanks(Cloud(0.3, 0, 3), here, axes, 6).value(), 1e-6);
  EXPECT_LT(TestPlaneRanks(Cloud(0, 0.01, 4), here, axes, 6).value(), 1e-6);
}

// Of three directions one is likelier to differ by chance than of one (Bonferroni).
TEST(PlaneRankTest, TakesThreeTimesTheLeastOfTheDirectionsChances) {
  const auto here = Cloud(0, 0, 1), beside = Cloud(0.1, 0.0003, 2);
  const Eigen::Matrix3d axes = ExpSo3({0.1, 0.2, 0.3});
  double least = 1.0;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> c, w;
    for (const Eigen::Vector3d& p : beside) c.push_back(axes.col(k).dot(p));
    for (const Eigen::Vector3d& p : here) w.push_back(axes.col(k).dot(p));
    least = std::min(least, TestRanks(c, w).p);
  }
  ASSERT_LT(3 * least, 1.0);
  EXPECT_DOUBLE_EQ(TestPlaneRanks(beside, here, axes, 6).value(), 3 * least);
}

// A large partner of a small sample is thinned, which must not lean to either end.
TEST(PlaneRankTest, SaysTheSameOfAMirroredSample) {
  Random random{9};
  for (int draw = 0; draw < 20; ++draw) {
    std::vector<double> few, many, few_mirrored, many_mirrored;
    for (int i = 0; i < 7; ++i) few.push_back(0.3 + random.Uniform());
    for (int i = 0; i < 201; ++i) many.push_back(std::pow(random.Uniform(), 2));
    for (const double v : few) few_mirrored.push_back(-v);
    for (const double v : many) many_mirrored.push_back(-v);
    EXPECT_DOUBLE_EQ(TestRanks(few, many).p, TestRanks(few_mirrored, many_mirrored).p);
    EXPECT_DOUBLE_EQ(TestRanks(many, few).p, TestRanks(many_mirrored, few_mirrored).p);
  }
}

TEST(PlaneAxes, GoAlongTheLongSideTheShortSideAndTheNormal) {
  const Eigen::Matrix3d R = ExpSo3({0.4, -0.2, 0.7});
  std::vector<Eigen::Vector3d> grid;  // 0.6 by 0.2 m, two metres off the origin
  for (int i = 0; i < 13; ++i) {
    for (int k = 0; k < 5; ++k) grid.emplace_back(R * Eigen::Vector3d(0.05 * i, 0.05 * k, 2.0));
  }
  const Eigen::Matrix3d axes = PlaneAxes({R.col(2), -2.0}, grid);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(std::abs(axes.col(k).dot(R.col(k))), 1, 1e-9) << k;
}

TEST(PlaneRankTest, RefusesSamplesThatAreTooSmall) {
  const auto cloud = Cloud(0, 0, 1);
  const std::vector<Eigen::Vector3d> three(cloud.begin(), cloud.begin() + 3);
  const auto test = TestPlaneRanks(three, cloud, Eigen::Matrix3d::Identity(), 6);
  ASSERT_FALSE(test.has_value());
}

}  // namespace
}  // namespace slam
