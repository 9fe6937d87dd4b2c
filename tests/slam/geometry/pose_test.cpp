#include "slam/geometry/pose.h"

#include <gtest/gtest.h>

#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

TEST(RotationBetween, TurnsTheOneIntoTheOtherAboutWhatIsSquareToBoth) {
  const Eigen::Vector3d from = Eigen::Vector3d(0.3, -0.2, 0.9).normalized();
  for (const Eigen::Vector3d& to :
       {Eigen::Vector3d(0.2, -0.3, 0.9), Eigen::Vector3d(-1, 0.5, 0.1),
        Eigen::Vector3d(-0.3, 0.25, -0.9), from}) {
    const Eigen::Matrix3d R = RotationBetween(from, to.normalized());
    EXPECT_THAT(R * from, VectorNear(to.normalized(), 1e-12));
    const Eigen::Vector3d axis = from.cross(to);
    EXPECT_THAT(R * axis, VectorNear(axis, 1e-12));
  }
}

TEST(Normalised, IsTheNearestRotationWhateverRoundingHasMadeOfIt) {
  const Pose exact{ExpSo3({0.4, -1.1, 0.7}), {0.1, 0.2, -0.3}};
  EXPECT_THAT(Normalised(exact), PoseNear(exact, 1e-12, 0.0));
  // Stretched along axes of its own it is not turned.
  Pose stretched = exact;
  const Eigen::Matrix3d axes = ExpSo3({-0.3, 0.2, 0.5});
  stretched.R =
      axes * Eigen::Vector3d(1.02, 0.97, 1.01).asDiagonal() * axes.transpose() * exact.R;
  const Pose mended = Normalised(stretched);
  EXPECT_LT((mended.R * mended.R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_THAT(mended, PoseNear(exact, 1e-9, 0.0));
}

}  // namespace
}  // namespace slam
