#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "slam/pose/pose_problem.h"
#include "slam/tracking/motion_filter.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

/// A camera that swings by 0.1 m and 3 degrees, once in a second and a half.
Pose SwayingPose(double t_s) {
  const double phase = 2 * M_PI * t_s / 1.5;
  const Vector6d swing = (Vector6d() << 0.1, 0.02, 0.03, 0.01, 0.05, 0.02).finished();
  return Exp(std::sin(phase) * swing);
}

/// The farthest that a camera is ever found from where it is, when three planes of a corner alone
/// tell that, measured at another time.
double FarthestOff_m(double late_s) {
  MotionFilter filter{{}};
  double farthest_m = 0.0;
  for (int i = 0; i < 150; ++i) {
    const double now_s = i / 30.0;
    const auto by_pose = filter.SpeedAt(now_s);
    if (!by_pose) {
      filter.Observe(now_s, SwayingPose(now_s), {.of_pose = 1e8 * Matrix6d::Identity()});
      continue;
    }
    PoseProblem problem;
    problem.prior = filter.Predict(now_s);
    problem.T_cw = problem.prior->T_cw;
    problem.late = LatePlanes{late_s, filter.Speed(now_s).mean, *by_pose};
    const Pose seen_from =
        Exp(-late_s * problem.late->compensated_speed) * SwayingPose(now_s + late_s);
    for (int axis = 0; axis < 3; ++axis) {
      PlaneConstraint c;
      c.pi_w = {Eigen::Vector3d::Unit(axis), 1.0};
      c.pi_c = Transform(seen_from, c.pi_w);
      c.centroid_c = ProjectOnto(c.pi_c, {0, 0, 1.5});
      c.angle_sigma_rad = 2e-4, c.offset_sigma_m = 3e-4;
      problem.planes.push_back(c);
    }
    const PoseSummary found = OptimisePose(problem, Camera{}, {});
    EXPECT_TRUE(found.usable);
    const Pose off = found.T_cw * Inverse(SwayingPose(now_s));
    if (i > 10) farthest_m = std::max(farthest_m, off.t.norm());
    filter.Observe(now_s, found.T_cw, found.evidence);
  }
  return farthest_m;
}

TEST(LateDepth, FollowsAHandByPlanesOfAnotherTime) {
  // It moves by up to 6 mm in 15 ms.
  EXPECT_LT(FarthestOff_m(0.0), 2e-4);
  EXPECT_LT(FarthestOff_m(0.015), 1e-3);
  EXPECT_LT(FarthestOff_m(-0.015), 1e-3);
  EXPECT_LT(FarthestOff_m(-0.02), 1.5e-3);  // where a speed by the pose alone runs away
}

}  // namespace
}  // namespace slam
