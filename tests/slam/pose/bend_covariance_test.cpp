#include "slam/pose/bend_covariance.h"

#include <gtest/gtest.h>

namespace slam {
namespace {

Frame FrameWithPlanesAt(const std::vector<double>& depths_m, double bend_ratio) {
  Frame frame;
  frame.bend_ratio = bend_ratio;
  for (const double z_m : depths_m) {
    FramePlane plane;
    plane.centroid_c = {0.3, -0.2, z_m};
    frame.planes.push_back(plane);
  }
  return frame;
}

TEST(BendCovariance, LiftsByTheShareOfTheDepthAndTiltsByTheShare) {
  const Matrix6d C = BendCovariance(FrameWithPlanesAt({1.0, 2.0, 3.0}, 0.005));
  const Vector6d expected =
      (Vector6d() << 0.01, 0.01, 0.01, 0.005, 0.005, 0.005).finished().cwiseAbs2();
  EXPECT_TRUE(C.isApprox(Matrix6d(expected.asDiagonal()), 1e-12)) << C;
}

TEST(PoseErrorCovariance, HoldsBothWhatIsIndependentAndWhatIsBent) {
  Frame frame = FrameWithPlanesAt({2.0}, 0.005);
  EXPECT_TRUE(PoseErrorCovariance(frame).isZero(0.0)) << "it is the world";
  frame.pose_covariance = 1e-4 * Matrix6d::Ones() + 2e-4 * Matrix6d::Identity();
  const Matrix6d C = PoseErrorCovariance(frame);
  EXPECT_NEAR(C(0, 0), 3e-4 + 1e-4, 1e-15);
  EXPECT_NEAR(C(5, 5), 3e-4 + 2.5e-5, 1e-15);
  EXPECT_NEAR(C(0, 5), 1e-4, 1e-15);
}

}  // namespace
}  // namespace slam
