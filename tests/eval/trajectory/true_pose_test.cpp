#include "eval/trajectory/true_pose.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "eval/formats/stamps.h"

namespace eval {
namespace {

Pose At(double x) {
  Pose pose;
  pose.t = {x, 0, 0};
  return pose;
}

TEST(PoseAt, OfAStampThatIsARoundingOffIsThePoseItself) {
  const Trajectory poses{{1.0, At(1)}, {1.1, At(2)}, {5.0, At(3)}};
  for (const double rounding_s : {-0.5 * kSameStamp_s, 0.0, 0.5 * kSameStamp_s}) {
    for (const StampedPose& pose : poses) {
      const auto found = PoseAt(poses, pose.stamp_s + rounding_s);
      ASSERT_TRUE(found) << pose.stamp_s << " " << rounding_s;
      EXPECT_EQ(found->t, pose.T_wc.t);
    }
  }
}

TEST(PoseAt, LiesBetweenItsNeighboursAndNowhereElse) {
  Trajectory poses(3);
  poses[0].stamp_s = 1.0;
  poses[1] = {1.1,
              {Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {1, 0, 0}}};
  poses[2].stamp_s = 1.5;
  const auto pose = PoseAt(poses, 1.025);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->t.x(), 0.25, 1e-9);
  EXPECT_NEAR(AngleOf(pose->R), 0.05, 1e-9);
  EXPECT_EQ(PoseAt(poses, 1.1)->t.x(), 1.0);
  EXPECT_FALSE(PoseAt(poses, 0.99));
  EXPECT_FALSE(PoseAt(poses, 1.3)) << "a gap of 0.4 s";
  EXPECT_FALSE(PoseAt(poses, 1.51));
  EXPECT_TRUE(PoseAt(poses, 1.5));
}

}  // namespace
}  // namespace eval
