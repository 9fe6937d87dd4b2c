#include <gtest/gtest.h>
#include <Eigen/QR>

#include <cmath>
#include <utility>

#include "slam/pose/factors/box.h"
#include "slam/pose/factors/parallel.h"
#include "slam/pose/factors/perpendicular.h"
#include "slam/pose/factors/plane.h"
#include "slam/pose/factors/point.h"

namespace slam {
namespace {

/// q(pi) as printed for the camera frame, with its typing error mended.
Eigen::Vector3d Chart(const Plane& pi) {
  return {std::atan2(pi.n.y(), pi.n.x()), std::asin(pi.n.z()), pi.d};
}

TEST(PlaneFactorEq16, IsSmallWhereTheCameraFrameChartJumps) {
  // The fronto-parallel surface, measured with an error of a hundredth of a degree.
  const double error = 1.7e-4;
  const Eigen::Vector3d n_1 = ExpSo3({error, 0, 0}) * -Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d n_2 = ExpSo3({0, error, 0}) * -Eigen::Vector3d::UnitZ();
  PlaneConstraint c;
  c.pi_c = {n_1, 1.0};
  c.pi_w = {n_2, 1.0};
  c.centroid_c = ProjectOnto(c.pi_c, {0, 0, 1});
  const Linearised<4> factor = PlaneFactor(c, Pose{});
  EXPECT_NEAR(factor.r.head<3>().norm(), std::sqrt(2.0) * error, 1e-9);
  EXPECT_GT(std::abs(Chart(c.pi_c)[0] - Chart(c.pi_w)[0]), 1.0);  // the printed phi: a radian
}

TEST(PlaneFactorEq16, MeasuresTheOffsetAtThePatchNotAtTheCamera) {
  // Turned by one degree about the patch, three metres away: the patch has not moved.
  const Eigen::Vector3d x_c(1, 0, 3);
  const Eigen::Vector3d n(0, 0, -1), turned = ExpSo3({0, M_PI / 180, 0}) * n;
  PlaneConstraint c;
  c.pi_w = {n, -n.dot(x_c)};
  c.pi_c = {turned, -turned.dot(x_c)};
  c.centroid_c = x_c;
  EXPECT_NEAR(PlaneFactor(c, Pose{}).r[3], 0.0, 1e-12);
  EXPECT_GT(std::abs(c.pi_w.d - c.pi_c.d), 0.015);  // the printed difference of d
}

TEST(PlaneFactorEq16, SaysNothingAboutAPlaneSeenFromBehind) {
  PlaneConstraint c;
  c.pi_w = {Eigen::Vector3d::UnitZ(), 1};
  c.pi_c = {-Eigen::Vector3d::UnitZ(), 1};
  const Linearised<4> factor = PlaneFactor(c, Pose{});
  EXPECT_FALSE(factor.valid);
  EXPECT_TRUE(factor.r.allFinite() && factor.J.allFinite());
}

TEST(PointFactorEq14, IsNotValidBehindTheCamera) {
  PointConstraint c;
  c.p_w = {0, 0, -1};
  c.u_px = {320, 240};
  EXPECT_FALSE(PointFactor(c, Pose{}, Camera{}).valid);
}

TEST(PointFactorEq14, HasTwoRowsWithoutDepth) {
  PointConstraint c;
  c.p_w = {0.1, 0.1, 1};
  c.u_px = {320, 240};
  const Linearised<3> factor = PointFactor(c, Pose{}, Camera{});
  EXPECT_EQ(factor.r[2], 0.0);
  EXPECT_TRUE(factor.J.row(2).isZero());
}

TEST(PointFactorEq14, CountsStandardDeviations) {
  const Camera camera;
  PointConstraint c;
  c.p_w = {0.2, -0.1, 1.6};
  c.u_px = camera.Project(c.p_w) - Eigen::Vector2d(2.4, -0.6);
  c.sigma_px = 1.2;
  c.depth_m = 1.6 + 1e-6, c.depth_sigma_m = 5e-7;
  EXPECT_LT((PointFactor(c, Pose{}, camera).r - Eigen::Vector3d(2, -0.5, 2)).norm(), 1e-5);
}

TEST(BoxFactorEq17, LeavesOutTheSidesThatCarryNoInformation) {
  BoxConstraint c;
  c.corners_w = {{-.1, -.1, 1}, {.1, -.1, 1}, {.1, .1, 1}, {-.1, .1, 1}};
  c.box_obs_px = {Eigen::Vector2d(0, 100), Eigen::Vector2d(300, 300)};
  c.use = {false, true, true, false};
  const Linearised<4> factor = BoxFactor(c, Pose{}, Camera{});
  ASSERT_TRUE(factor.valid);
  EXPECT_EQ(factor.r[0], 0.0);
  EXPECT_EQ(factor.r[3], 0.0);
  EXPECT_NE(factor.r[1], 0.0);
  EXPECT_NE(factor.r[2], 0.0);
  EXPECT_TRUE(factor.J.row(0).isZero() && factor.J.row(3).isZero());
}

/// The step that a factor alone would take, the shortest that brings its residual to zero.
Vector6d Step(const Linearised<4>& factor) {
  return factor.J.completeOrthogonalDecomposition().solve(-factor.r);
}

TEST(BoxFactorEq17, LeavesTheTruePoseAloneWhereTheImageCutsTheBox) {
  const Camera camera;
  BoxConstraint c;
  c.corners_w = {{-.7, -.1, 1}, {-.1, -.1, 1}, {-.1, .2, 1}, {-.7, .2, 1}};
  Box seen;
  for (const Eigen::Vector3d& p_w : c.corners_w) seen.Include(camera.ProjectDistorted(p_w));
  ASSERT_LT(seen.min.x(), 0.0);  // beyond the left border, at which a detector ends the box
  seen.min.x() = 0.0;
  c.box_obs_px = seen;
  c.use = {false, true, true, true};
  const Linearised<4> factor = BoxFactor(c, Pose{}, camera);
  ASSERT_TRUE(factor.valid);
  EXPECT_LT(Step(factor).norm(), 1e-9);
  c.use = {true, true, true, true};  // as printed: all four components of eta
  EXPECT_GT(Step(BoxFactor(c, Pose{}, camera)).head<3>().norm(), 0.01);  // metres
}

TEST(BoxFactorEq17, IsOfPixelsAsTheLensShowsThem) {
  Camera camera;
  camera.k1 = 0.25, camera.k2 = -0.9, camera.k3 = 1.1, camera.p1 = -0.005, camera.p2 = 0.003;
  BoxConstraint c;
  c.corners_w = {{-.5, -.35, 1}, {-.2, -.35, 1}, {-.2, -.1, 1}, {-.5, -.1, 1}};
  Box seen;
  for (const Eigen::Vector3d& p_w : c.corners_w) seen.Include(camera.ProjectDistorted(p_w));
  ASSERT_GT((camera.ProjectDistorted(c.corners_w[0]) - camera.Project(c.corners_w[0])).norm(),
            1.0);
  c.box_obs_px = seen;
  c.use = {true, true, true, true};
  const Linearised<4> factor = BoxFactor(c, Pose{}, camera);
  ASSERT_TRUE(factor.valid);
  EXPECT_LT(factor.r.norm(), 1e-9);
}

TEST(BoxFactorEq17, IsNotValidWhenACornerIsBehindTheCamera) {
  BoxConstraint c;
  c.corners_w = {{-.1, -.1, 1}, {.1, -.1, 1}, {.1, .1, 1}, {-.1, .1, -1}};
  c.box_obs_px = {Eigen::Vector2d(0, 100), Eigen::Vector2d(300, 300)};
  EXPECT_FALSE(BoxFactor(c, Pose{}, Camera{}).valid);
}

TEST(ParallelFactorEq19, AcceptsFacesThatLookAtEachOther) {
  const Eigen::Vector3d n = Eigen::Vector3d(0.1, 0.2, 1).normalized();
  EXPECT_NEAR(ParallelFactor({-n, n, 0.02}, Pose{}).r.norm(), 0.0, 1e-15);
  // Turned a little, they are as far from parallel as faces that look the same way.
  const Eigen::Vector3d turned = ExpSo3({0.05, -0.02, 0.01}) * n;
  const Linearised<3> same = ParallelFactor({turned, n, 0.02}, Pose{});
  const Linearised<3> facing = ParallelFactor({-turned, n, 0.02}, Pose{});
  EXPECT_TRUE(facing.valid);
  EXPECT_NEAR(facing.r.norm(), std::acos(turned.dot(n)), 1e-6);
  EXPECT_EQ(facing.r, same.r);
  EXPECT_EQ(facing.J, same.J);
}

/// q_n as printed: azimuth and elevation in the camera's axes.
Eigen::Vector2d Angles(const Eigen::Vector3d& n) { return Chart({n, 0.0}).head<2>(); }

TEST(ParallelFactorEq19, IsSmallWhereAzimuthAndElevationJump) {
  // A hundredth of a degree apart: about the optical axis, and on both sides of azimuth pi.
  constexpr double kError = 1.7e-4;
  const Eigen::Vector3d axis = -Eigen::Vector3d::UnitZ(), left = -Eigen::Vector3d::UnitX();
  const std::pair<Eigen::Vector3d, Eigen::Vector3d> pairs[] = {
      {ExpSo3({0.5 * kError, 0, 0}) * axis, ExpSo3({-0.5 * kError, 0, 0}) * axis},
      {ExpSo3({0, 0, 0.5 * kError}) * left, ExpSo3({0, 0, -0.5 * kError}) * left}};
  for (const auto& [n_c, n_w] : pairs) {
    const Linearised<3> factor = ParallelFactor({n_w, n_c, 0.02}, Pose{});
    ASSERT_TRUE(factor.valid);
    EXPECT_NEAR(factor.r.norm(), kError, 1e-9);
    EXPECT_GT((Angles(n_c) - Angles(n_w)).norm(), 3.0);  // as printed
  }
}

TEST(PerpendicularFactorEq20, IsZeroForEveryPlaneAtARightAngle) {
  // Walls that face anywhere around a floor. Whatever one turn R_perp by a right angle is
  // printed, it holds for one of them alone.
  const Eigen::Vector3d n_c = Eigen::Vector3d(0.1, -0.9, -0.3).normalized();
  const Eigen::Vector3d side = n_c.unitOrthogonal();
  const Eigen::Vector3d R_perp_n_c = ExpSo3(0.5 * M_PI * n_c.cross(side)) * n_c;
  ASSERT_LT((R_perp_n_c - side).norm(), 1e-12);
  constexpr int kWalls = 12;
  int printed = 0;
  for (int wall = 0; wall < kWalls; ++wall) {
    const Eigen::Vector3d n_w = ExpSo3(2 * M_PI * wall / kWalls * n_c) * side;
    const Linearised<1> factor = PerpendicularFactor({n_w, n_c, 0.02}, Pose{});
    ASSERT_TRUE(factor.valid);
    EXPECT_NEAR(factor.r[0], 0.0, 1e-12) << wall;
    EXPECT_NEAR((factor.J.rightCols<3>() * n_c).norm(), 0.0, 1e-12) << wall;  // one freedom
    printed += (Angles(R_perp_n_c) - Angles(n_w)).norm() > 0.1 ? 1 : 0;
    // A wall that leans by so much is off by as much, whichever way it faces.
    const Eigen::Vector3d leaning_w = ExpSo3(0.02 * n_w.cross(n_c)) * n_w;
    EXPECT_NEAR(PerpendicularFactor({leaning_w, n_c, 0.02}, Pose{}).r[0], 0.02, 1e-12);
  }
  EXPECT_EQ(printed, kWalls - 1);
}

TEST(PerpendicularFactorEq20, HasNoGradientWhereThePlanesAreParallel) {
  const Eigen::Vector3d n = Eigen::Vector3d::UnitZ();
  const Linearised<1> factor = PerpendicularFactor({n, n, 0.02}, Pose{});
  EXPECT_FALSE(factor.valid);
  EXPECT_TRUE(factor.J.isZero());
}

}  // namespace
}  // namespace slam
