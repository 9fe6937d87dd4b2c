#include "slam/pose/late_planes.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "slam/base/random.h"
#include "slam/pose/pose_problem.h"
#include "tests/support/plane_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

using Matrix12d = Eigen::Matrix<double, 12, 12>;
using Vector12d = Eigen::Matrix<double, 12, 1>;

Vector6d Drawn(Random& random, double size) {
  Vector6d v;
  for (int i = 0; i < 6; ++i) v[i] = size * Normal(random);
  return v;
}

Matrix6d DrawnSquare(Random& random) {
  Matrix6d A;
  for (int i = 0; i < 6; ++i) A.col(i) = Drawn(random, 1.0);
  return A * A.transpose() + Matrix6d::Identity();
}

TEST(LatePlanes, SayOfThePoseWhatPoseAndSpeedTogetherDo) {
  // Steps so small that poses add up: then pose and speed are twelve numbers, and least squares over
  // all of them is solved at once.
  constexpr double kSmall = 1e-5;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random{seed};
    LatePlanes late;
    late.late_s = 0.03 * (random.Uniform() - 0.5);
    late.compensated_speed = Drawn(random, kSmall);
    late.speed.speed = Drawn(random, kSmall);
    late.speed.gain = 10 * DrawnSquare(random) / 6;
    late.speed.covariance = 1e3 * DrawnSquare(random);
    const Matrix6d prior = DrawnSquare(random), seen = 100 * DrawnSquare(random);
    const Vector6d measured = Drawn(random, kSmall);  // the pose later, as it is compensated

    // The whole: x by its prior, v by x, and x + late (v - compensated) by the planes.
    Matrix12d H = Matrix12d::Zero();
    Vector12d g = Vector12d::Zero();
    const auto add = [&](const Matrix6d& by_x, const Matrix6d& by_v, const Vector6d& r,
                         const Matrix6d& W) {
      Eigen::Matrix<double, 6, 12> J;
      J << by_x, by_v;
      H += J.transpose() * W * J;
      g += J.transpose() * W * r;
    };
    const Matrix6d I = Matrix6d::Identity(), none = Matrix6d::Zero();
    add(I, none, Vector6d::Zero(), prior);
    add(-late.speed.gain, I, -late.speed.speed, late.speed.covariance.inverse());
    add(I, late.late_s * I, -late.late_s * late.compensated_speed - measured, seen);
    const Vector12d both = -H.inverse() * g;

    // The same by the pose alone.
    const auto seen_at = [&](const Pose& T_cw) {
      NormalEquations at;
      const Vector6d r = Log(late.SeenFrom(T_cw)) - measured;
      at.H = seen.triangularView<Eigen::Upper>();  // as it is summed
      at.g = seen * r, at.cost = 0.5 * r.dot(seen * r);
      return at;
    };
    const NormalEquations by_pose = late.OfPose(seen_at(Pose{}));
    const Matrix6d information = prior + by_pose.H;
    const Vector6d x = -information.ldlt().solve(by_pose.g);
    EXPECT_LT((x - both.head<6>()).norm(), 1e-3 * both.head<6>().norm()) << seed;
    const Matrix6d covariance = Matrix12d(H.inverse()).topLeftCorner<6, 6>();
    EXPECT_LT((information.inverse() - covariance).norm(), 1e-9 * covariance.norm()) << seed;
    const Pose found = Exp(x);
    const Vector6d v = late.SpeedAt(found, seen_at(found));
    EXPECT_LT((v - both.tail<6>()).norm(), 1e-3 * both.tail<6>().norm()) << seed;

    // The cost falls as its gradient says.
    const Vector6d step = Drawn(random, 0.1 * kSmall);
    const double fallen =
        late.OfPose(seen_at(Exp(step))).cost - late.OfPose(seen_at(Exp(-step))).cost;
    EXPECT_NEAR(fallen, 2 * by_pose.g.dot(step), 1e-3 * std::abs(fallen) + 1e-18) << seed;
  }
}

/// Three planes of a corner, as a camera at T_cw that moves at `speed` compensates them when it takes the
/// speed for `compensated`.
PoseProblem SeenLate(const Pose& T_cw, double late_s, const Vector6d& speed,
                     const Vector6d& compensated) {
  PoseProblem problem;
  problem.T_cw = Exp((Vector6d() << 0.01, -0.02, 0.01, 0.01, 0.02, -0.01).finished()) * T_cw;
  const Pose seen_from = Exp(-late_s * compensated) * Exp(late_s * speed) * T_cw;
  for (int i = 0; i < 3; ++i) {
    PlaneConstraint c;
    c.pi_w = {Eigen::Vector3d::Unit(i), 1.0 + i};
    c.pi_c = Transform(seen_from, c.pi_w);
    c.centroid_c = ProjectOnto(c.pi_c, {0.1, 0.2, 1.5});
    c.angle_sigma_rad = 0.001, c.offset_sigma_m = 0.001;
    problem.planes.push_back(c);
  }
  problem.late = LatePlanes{late_s, compensated, {}};
  problem.late->speed.predicted_cw = T_cw;
  problem.late->speed.speed = speed;
  return problem;
}

TEST(PoseOptimiserEq13, FindsThePoseByPlanesOfAnotherTime) {
  const Pose T_cw{ExpSo3({0.3, -0.2, 0.1}), {0.4, -0.3, 0.2}};
  const Vector6d speed = (Vector6d() << 0.3, -0.1, 0.2, 0.5, -0.4, 0.3).finished();
  for (const double late_s : {0.015, -0.018}) {
    for (const double compensated : {0.0, 1.0, 3.0}) {  // as a part of the speed
      const PoseProblem problem = SeenLate(T_cw, late_s, speed, compensated * speed);
      const PoseSummary found = OptimisePose(problem, Camera{}, {});
      EXPECT_THAT(found.T_cw, PoseNear(T_cw, 1e-6, 1e-6)) << late_s << " " << compensated;
      ASSERT_TRUE(found.evidence.speed);
      EXPECT_LT((*found.evidence.speed - speed).norm(), 1e-4);
      EXPECT_TRUE(found.evidence.of_pose.isZero());  // nothing was measured at its time
      EXPECT_EQ(found.evidence.late_s, late_s);
    }
  }
}

TEST(PoseOptimiserEq13, KnowsAsMuchByPlanesOfAnotherTimeThatAgreeAsIfTheyWereOfItsOwn) {
  const Pose T_cw{ExpSo3({0.3, -0.2, 0.1}), {0.4, -0.3, 0.2}};
  const Vector6d speed = (Vector6d() << 0.3, -0.1, 0.2, 0.5, -0.4, 0.3).finished();
  for (const double late_s : {0.015, -0.018}) {
    for (const double compensated : {0.0, 1.0, 3.0}) {  // as a part of the speed
      const PoseProblem late = SeenLate(T_cw, late_s, speed, compensated * speed);
      // The same planes, looked at from where they are seen.
      PoseProblem in_time;
      in_time.T_cw = late.late->SeenFrom(T_cw);
      in_time.planes = late.planes;
      const Matrix6d expected = OptimisePose(in_time, Camera{}, {}).evidence.of_pose;
      ASSERT_GT(expected.norm(), 1e6);
      const MotionEvidence found = OptimisePose(late, Camera{}, {}).evidence;
      EXPECT_LT((found.of_late_pose - expected).norm(), 1e-4 * expected.norm())
          << late_s << " " << compensated;
    }
  }
}

}  // namespace
}  // namespace slam
