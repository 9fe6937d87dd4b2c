#include "slam/pose/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/base/random.h"
#include "slam/pose/pose_problem.h"

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

TEST(BendCovariance, LiftsAFrameWithoutPlanesByWhereItsPointsLie) {
  Frame frame = FrameWithPlanesAt({}, 0.005);
  EXPECT_EQ(BendCovariance(frame)(2, 2), 0.0) << "nothing is measured";
  for (const double z_m : {0.0, 2.0, 4.0}) frame.features.emplace_back().depth_m = z_m;
  EXPECT_NEAR(BendCovariance(frame)(2, 2), 0.015 * 0.015, 1e-12) << "one has no depth";
  frame.planes = FrameWithPlanesAt({1.0}, 0.005).planes;
  EXPECT_NEAR(BendCovariance(frame)(2, 2), 0.005 * 0.005, 1e-12) << "planes go before points";
}

TEST(ShutterCovariance, OfATurnIsATurnAndOfAStepAStep) {
  for (const int axis : {0, 1, 2, 3, 4, 5}) {
    Frame frame;
    frame.readout.sigma_s = 0.02;
    frame.readout.speed = 0.5 * Vector6d::Unit(axis);
    // Half of the reading time away from the middle row: 5 mm, or 5 mrad.
    const Vector6d expected = axis < 3 ? (Vector6d() << 1, 1, 1, 0, 0, 0).finished()
                                       : (Vector6d() << 0, 0, 0, 1, 1, 1).finished();
    const Matrix6d C = ShutterCovariance(frame);
    EXPECT_TRUE(C.isApprox(Matrix6d(0.005 * 0.005 * expected.asDiagonal()), 1e-12)) << axis;
  }
}

/// A camera that moves so sees points row by row; the pose that fits them, as if it had not.
Pose FitWhileRead(const Readout& readout, Random& random) {
  const Camera camera;
  PoseProblem problem;
  for (int k = 0; k < 300; ++k) {
    const Eigen::Vector2d u_px(640 * random.Uniform(), 480 * random.Uniform());
    const double z_m = 1.0 + random.Uniform();
    const Eigen::Vector3d x = camera.Backproject(u_px, z_m);
    const Eigen::Vector3d x_r = readout.T_rc(camera.RowShare(u_px.y())) * x;
    problem.points.push_back({x, camera.Project(x_r), 1.0, x_r.z(), 0.005});
  }
  return OptimisePose(problem, camera, {}).T_cw;
}

TEST(ShutterCovariance, CoversWhatAShutterOfOneStandardDeviationDoesToAPose) {
  Random random({17});
  constexpr int kRuns = 30;
  double turns = 0.0, shifts = 0.0;  // squares, in variances
  for (int k = 0; k < kRuns; ++k) {
    Frame frame = FrameWithPlanesAt({1.5}, 0.0);
    frame.readout.sigma_s = 0.02;
    for (int i = 0; i < 6; ++i) frame.readout.speed[i] = random.Uniform() - 0.5;
    Readout read = frame.readout;
    read.taken_out_s = frame.readout.sigma_s;
    const Vector6d off = Log(FitWhileRead(read, random));
    const Matrix6d C = ShutterCovariance(frame);
    EXPECT_LT(off.tail<3>().norm(), 2 * std::sqrt(C(5, 5))) << k;
    EXPECT_LT(off.head<3>().norm(), 2 * std::sqrt(C(0, 0))) << k;
    turns += off.tail<3>().squaredNorm() / C(5, 5) / kRuns;
    shifts += off.head<3>().squaredNorm() / C(0, 0) / kRuns;
    frame.readout.sigma_s = 0.0;
    EXPECT_TRUE(ShutterCovariance(frame).isZero(0.0));
  }
  // As wide as that, and not much wider: the mean of three squares.
  EXPECT_GT(turns / 3, 0.1);
  EXPECT_GT(shifts / 3, 0.1);
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

TEST(WorldErrorCovariance, IsThatTowardsTheMapButNoSmallerThanTheMapsOwn) {
  Frame frame = FrameWithPlanesAt({2.0}, 0.005);
  frame.map_covariance(1, 1) = 0.04;
  EXPECT_TRUE(WorldErrorCovariance(frame).isZero(0.0)) << "it is the world";
  frame.pose_covariance = 1e-4 * Matrix6d::Identity();
  const Matrix6d C = WorldErrorCovariance(frame);
  EXPECT_NEAR(C(0, 0), 1e-4 + 1e-4, 1e-12);
  EXPECT_NEAR(C(1, 1), 0.04 + 1e-4, 1e-12);
  frame.map_covariance.setZero();
  EXPECT_EQ(WorldErrorCovariance(frame), PoseErrorCovariance(frame));
}

}  // namespace
}  // namespace slam
