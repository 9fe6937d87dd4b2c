// What explains a trajectory that is far off: another unit, a mirror, or nothing of the kind.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "eval/trajectory/alignment.h"

namespace eval {
namespace {

using WindingPoints = std::vector<Eigen::Vector3d>;

/// A winding that no rigid motion lays on its mirror image.
WindingPoints Winding() {
  WindingPoints points;
  for (int i = 0; i < 60; ++i) {
    const double a = 0.2 * i;
    points.emplace_back(0.5 * std::cos(a), 0.5 * std::sin(a), 0.02 * i);
  }
  return points;
}

/// Seen from another world, with an error of `sigma_m`.
WindingPoints SeenFromElsewhere(const WindingPoints& truth, double scale, bool mirrored,
                                double sigma_m) {
  std::mt19937 random(1);
  std::normal_distribution<double> error(0.0, sigma_m);
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  WindingPoints points;
  for (Eigen::Vector3d p : truth) {
    if (mirrored) p.y() = -p.y();
    points.push_back(scale * (turn * p + Eigen::Vector3d(3, 2, 1)));
    for (int i = 0; i < 3; ++i) points.back()[i] += error(random);
  }
  return points;
}

TEST(FindBetterFit, FindsTheUnitThatIsWrong) {
  for (const double scale : {0.2, 5000 / 6553.5, 5.0}) {
    const auto fit =
        FindBetterFit(SeenFromElsewhere(Winding(), scale, false, 0.01 * scale), Winding());
    ASSERT_TRUE(fit.has_value()) << scale;
    EXPECT_NEAR(fit->scale * scale, 1.0, 0.01);
    EXPECT_FALSE(fit->mirrored);
    EXPECT_NEAR(fit->rmse_m, 0.017, 0.003) << "sqrt(3) of 10 mm";
    EXPECT_GT(fit->rigid_rmse_m, 4 * fit->rmse_m);
  }
}

TEST(FindBetterFit, FindsAMirrorWithAndWithoutAnotherUnit) {
  const auto mirrored = FindBetterFit(SeenFromElsewhere(Winding(), 1.0, true, 0.01), Winding());
  ASSERT_TRUE(mirrored.has_value());
  EXPECT_TRUE(mirrored->mirrored);
  EXPECT_EQ(mirrored->scale, 1.0);
  const auto both = FindBetterFit(SeenFromElsewhere(Winding(), 0.2, true, 0.002), Winding());
  ASSERT_TRUE(both.has_value());
  EXPECT_TRUE(both->mirrored);
  EXPECT_NEAR(both->scale, 5.0, 0.05);
}

TEST(FindBetterFit, FindsNothingInErrorsOfAnotherKind) {
  const WindingPoints truth = Winding();
  EXPECT_FALSE(FindBetterFit(truth, truth));
  EXPECT_FALSE(FindBetterFit(SeenFromElsewhere(truth, 1.0, false, 0.2), truth)) << "noise";
  EXPECT_FALSE(FindBetterFit(SeenFromElsewhere(truth, 1.04, false, 0.001), truth))
      << "focal length and depth of a device are off by as much";
  WindingPoints drifting = truth;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    drifting[i] *= 1.0 + 0.01 * static_cast<double>(i);
  }
  EXPECT_FALSE(FindBetterFit(drifting, truth));
  WindingPoints flat = truth;
  for (Eigen::Vector3d& p : flat) p.z() *= 1e-3;
  EXPECT_FALSE(FindBetterFit(SeenFromElsewhere(flat, 1.0, true, 0.01), flat))
      << "the mirror image of a flat path is a turn of it";
  EXPECT_FALSE(FindBetterFit(WindingPoints(5, {1, 2, 3}), WindingPoints(5, {3, 2, 1})));
}

}  // namespace
}  // namespace eval
