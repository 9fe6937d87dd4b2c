#include "eval/trajectory/true_pose.h"

#include <gtest/gtest.h>

#include "eval/formats/stamps.h"

namespace eval {
namespace {

Pose At(double x) {
  Pose pose;
  pose.t = {x, 0, 0};
  return pose;
}

TEST(TruePose, OfAStampThatIsARoundingOffIsThePoseItself) {
  const Trajectory poses{{1.0, At(1)}, {1.1, At(2)}, {5.0, At(3)}};
  for (const double rounding_s : {-0.5 * kSameStamp_s, 0.0, 0.5 * kSameStamp_s}) {
    for (const StampedPose& pose : poses) {
      const auto found = PoseAt(poses, pose.stamp_s + rounding_s);
      ASSERT_TRUE(found) << pose.stamp_s << " " << rounding_s;
      EXPECT_EQ(found->t, pose.T_wc.t);
    }
  }
}

TEST(TruePose, IsBetweenNeighboursAndNowhereBeyondNorInAGap) {
  const Trajectory poses{{1.0, At(1)}, {1.1, At(2)}, {5.0, At(3)}};
  EXPECT_NEAR(PoseAt(poses, 1.025)->t.x(), 1.25, 1e-12);
  EXPECT_FALSE(PoseAt(poses, 0.9));
  EXPECT_FALSE(PoseAt(poses, 3.0));
  EXPECT_FALSE(PoseAt(poses, 5.1));
}

}  // namespace
}  // namespace eval
