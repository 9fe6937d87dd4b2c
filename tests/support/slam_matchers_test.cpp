#include "tests/support/slam_matchers.h"

#include <gtest/gtest.h>

namespace slam {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StringMatchResultListener;

TEST(PoseNear, AcceptsWithinBothTolerancesAndRefusesBeyondEither) {
  const Pose turned{ExpSo3({0, 0, 0.01}), {0, 0, 0}};
  const Pose moved{Eigen::Matrix3d::Identity(), {0.01, 0, 0}};
  EXPECT_THAT(turned, PoseNear(Pose{}, 0.011, 0.0));
  EXPECT_THAT(turned, Not(PoseNear(Pose{}, 0.009, 1.0)));
  EXPECT_THAT(moved, PoseNear(Pose{}, 0.0, 0.011));
  EXPECT_THAT(moved, Not(PoseNear(Pose{}, 1.0, 0.009)));
}

TEST(PlaneNear, TellsTheFrontFromTheBackAndPrintsBothSides) {
  const Plane front{Eigen::Vector3d::UnitZ(), 1.0};
  const Plane back{-front.n, -front.d};
  StringMatchResultListener listener;
  EXPECT_FALSE(::testing::ExplainMatchResult(PlaneNear(front, 0.1, 0.1), back, &listener));
  EXPECT_THAT(listener.str(), HasSubstr("actual"));
  EXPECT_THAT(listener.str(), HasSubstr("expected"));
}

}  // namespace
}  // namespace slam
