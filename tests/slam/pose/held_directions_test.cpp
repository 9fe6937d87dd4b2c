#include "slam/pose/held_directions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "slam/pose/pose_problem.h"

namespace slam {
namespace {

UncertainPose Predicted() {
  UncertainPose predicted;
  predicted.covariance.diagonal() << 1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4;
  return predicted;
}

PoseSummary SeenByPlanes(const std::vector<Eigen::Vector3d>& normals_w) {
  PoseProblem problem;
  problem.prior = Predicted();
  problem.T_cw = problem.prior->T_cw;
  for (const Eigen::Vector3d& n : normals_w) {
    PlaneConstraint c;
    c.pi_w = c.pi_c = {n, 1.0};
    c.centroid_c = -n;
    c.offset_sigma_m = 0.002;
    c.angle_sigma_rad = 0.002;
    problem.planes.push_back(c);
  }
  return OptimisePose(problem, Camera{}, FeatureScale{}, {});
}

/// Whether some of the axes is this one, either way round.
bool Holds(const std::vector<MotionAxis>& axes, bool turn, const Eigen::Vector3d& along) {
  return std::any_of(axes.begin(), axes.end(), [&](const MotionAxis& axis) {
    return axis.turn == turn && std::abs(axis.axis_c.dot(along.normalized())) > 0.999;
  });
}

TEST(HeldByPrediction, OfOnePlaneTwoStepsAndTheTurnAboutItsNormal) {
  const PoseSummary summary = SeenByPlanes({-Eigen::Vector3d::UnitZ()});
  EXPECT_TRUE(summary.usable);  // the prediction holds the rest
  const auto axes = HeldByPrediction(Predicted().covariance, summary.covariance);
  ASSERT_EQ(axes.size(), 3u);
  EXPECT_NEAR(axes[0].axis_c.z(), 0.0, 0.05);
  EXPECT_NEAR(axes[1].axis_c.z(), 0.0, 0.05);
  EXPECT_FALSE(axes[0].turn || axes[1].turn);
  EXPECT_TRUE(Holds(axes, true, {0, 0, 1}));
}

TEST(HeldByPrediction, OfTwoParallelPlanesTheSame) {
  const PoseSummary summary =
      SeenByPlanes({-Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitZ()});
  EXPECT_EQ(HeldByPrediction(Predicted().covariance, summary.covariance).size(), 3u);
}

TEST(HeldByPrediction, OfACorridorItsLength) {
  const PoseSummary summary = SeenByPlanes({{1, 0, 0}, {0, -1, 0}});
  const auto axes = HeldByPrediction(Predicted().covariance, summary.covariance);
  ASSERT_EQ(axes.size(), 1u);
  EXPECT_TRUE(Holds(axes, false, {0, 0, 1}));
}

TEST(HeldByPrediction, OfACornerNothing) {
  const PoseSummary summary = SeenByPlanes({{1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  EXPECT_TRUE(HeldByPrediction(Predicted().covariance, summary.covariance).empty());
}

PlaneConstraint Seen(const Eigen::Vector3d& n) {
  PlaneConstraint plane;
  plane.pi_w = plane.pi_c = {n.normalized(), 1.0};
  return plane;
}

TEST(UnseenSteps, OfPanelsTheirHeightThoughTheirNormalsErr) {
  const auto unseen = UnseenSteps({Seen({0.5, 0.02, -0.8}), Seen({-0.4, -0.03, -0.9})});
  ASSERT_EQ(unseen.size(), 1u);
  EXPECT_GT(std::abs(unseen[0].y()), 0.99);
}

TEST(UnseenSteps, OfPanelsOnAFloorNothing) {
  EXPECT_TRUE(
      UnseenSteps({Seen({0.5, 0, -0.8}), Seen({-0.4, 0, -0.9}), Seen({0, -1, 0.1})}).empty());
}

TEST(UnseenSteps, StayWherePredictedAndAsUncertain) {
  const std::vector<Eigen::Vector3d> steps{Eigen::Vector3d::UnitY()};
  const UncertainPose held = HeldAlong(Predicted(), steps);
  EXPECT_LT(held.covariance(1, 1), 1e-5 * Predicted().covariance(1, 1));
  EXPECT_NEAR(held.covariance(0, 0), Predicted().covariance(0, 0), 1e-12);
  const Matrix6d information = WithoutSteps(1e6 * Matrix6d::Identity(), steps);
  EXPECT_EQ(information(1, 1), 0.0);
  EXPECT_EQ(information(2, 2), 1e6);
}

}  // namespace
}  // namespace slam
