#include "slam/pose/held_directions.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

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
  return OptimisePose(problem, Camera{}, {});
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

/// Steps that no plane tells a camera that stands as the world does.
std::vector<Eigen::Vector3d> Unseen(const std::vector<PlaneConstraint>& planes) {
  return UnseenSteps(planes, Eigen::Matrix3d::Identity());
}

PlaneConstraint Seen(const Eigen::Vector3d& n) {
  PlaneConstraint plane;
  plane.pi_w = plane.pi_c = {n.normalized(), 1.0};
  return plane;
}

TEST(UnseenSteps, OfPanelsTheirHeightThoughTheirNormalsErr) {
  const auto unseen = Unseen({Seen({0.5, 0.02, -0.8}), Seen({-0.4, -0.03, -0.9})});
  ASSERT_EQ(unseen.size(), 1u);
  EXPECT_GT(std::abs(unseen[0].y()), 0.99);
}

TEST(UnseenSteps, OfPanelsOnAFloorNothing) {
  EXPECT_TRUE(
      Unseen({Seen({0.5, 0, -0.8}), Seen({-0.4, 0, -0.9}), Seen({0, -1, 0.1})}).empty());
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

TEST(UnseenSteps, OfOneWallAreTwoAndWithoutPlanesAllThree) {
  const auto unseen = Unseen({Seen({0.6, 0, -0.8}), Seen({0.6, 0, -0.8})});
  ASSERT_EQ(unseen.size(), 2u);
  for (const Eigen::Vector3d& step_c : unseen)
    EXPECT_NEAR(step_c.dot(Eigen::Vector3d(0.6, 0, -0.8)), 0.0, 1e-12);
  EXPECT_NEAR(unseen[0].dot(unseen[1]), 0.0, 1e-12);
  EXPECT_EQ(Unseen({}).size(), 3u);
}

TEST(UnseenSteps, AreSeenByAPlaneThatLiesMoreThanTenDegreesAcrossThem) {
  // A wide corridor, and a wall beside it that leans back: what the walls say of the height.
  const auto unseen_below = [](double lean_deg) {
    const double a = lean_deg * M_PI / 180;
    return Unseen({Seen({1, 0, 0}), Seen({-1, 0, 0}), Seen({0, 0, -1}), Seen({0, 0, -1}),
                   Seen({0, 0, -1}), Seen({0, -std::sin(a), -std::cos(a)})})
        .size();
  };
  EXPECT_EQ(unseen_below(8), 1u);
  EXPECT_EQ(unseen_below(15), 0u);
}

TEST(HeldAlong, IsThePredictionOfACameraWhoseHeightIsKnown) {
  // Height and pitch err together: who knows the one knows more of the other.
  UncertainPose predicted = Predicted();
  predicted.covariance(1, 3) = predicted.covariance(3, 1) = 8e-5;
  const UncertainPose held = HeldAlong(predicted, {Eigen::Vector3d::UnitY()});
  EXPECT_NEAR(held.covariance(3, 3), 1e-4 - 8e-5 * 8e-5 / 1e-4, 1e-9);
  EXPECT_NEAR(held.covariance(1, 3), 0.0, 1e-9);
  EXPECT_GT(held.covariance(1, 1), 0.0);
  EXPECT_EQ(HeldAlong(predicted, {}).covariance, predicted.covariance);
}

TEST(WithoutSteps, TakesWhatWasSaidOfAStepTogetherWithTurnsToo) {
  Matrix6d information = 1e4 * Matrix6d::Identity();
  information(1, 3) = information(3, 1) = 5e3;
  const Matrix6d left = WithoutSteps(information, {Eigen::Vector3d::UnitY()});
  EXPECT_EQ(left.row(1).norm(), 0.0);
  EXPECT_EQ(left.col(1).norm(), 0.0);
  EXPECT_EQ(left(3, 3), 1e4);
  EXPECT_EQ(WithoutSteps(information, {}), information);
}

// What the tracker makes of all this: panels that err by a degree say nothing of the height.
TEST(WithoutSteps, LeaveTheHeightAsUncertainAsPredictedWhateverTheWallsSay) {
  const std::vector<PlaneConstraint> walls{Seen({0.7, 0.02, -0.7}), Seen({-0.7, 0.02, -0.7}),
                                           Seen({0, -0.03, -1})};
  const auto unseen = Unseen(walls);
  ASSERT_EQ(unseen.size(), 1u);
  PoseProblem problem;
  problem.prior = HeldAlong(Predicted(), unseen);
  problem.planes = walls;
  for (PlaneConstraint& wall : problem.planes) {
    wall.pi_w.d += 0.01;  // a centimetre off: seven higher, if they were believed
    wall.centroid_c = -wall.pi_c.n;
    wall.offset_sigma_m = wall.angle_sigma_rad = 1e-3;
  }
  const PoseSummary summary = OptimisePose(problem, Camera{}, {});
  EXPECT_LT(std::abs(summary.T_cw.t.dot(unseen[0])), 1e-3);
  EXPECT_NEAR(std::abs(summary.T_cw.t.z()), 0.012, 0.003);
  const Matrix6d information = WithoutSteps(summary.evidence.of_pose, unseen);
  const Matrix6d predicted = Predicted().covariance;
  const Matrix6d known = (predicted.inverse() + information).inverse();
  Vector6d height = Vector6d::Zero();
  height.head<3>() = unseen[0];
  EXPECT_NEAR(height.dot(known * height), 1e-4, 1e-7);
}

}  // namespace
}  // namespace slam
