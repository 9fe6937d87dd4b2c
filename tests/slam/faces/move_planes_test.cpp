#include "slam/faces/move_planes.h"

#include <gtest/gtest.h>

#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

TEST(MovePlanes, TellsWhatAnotherCameraWouldHaveMeasured) {
  const Pose T_ba{ExpSo3({0.02, -0.01, 0.03}), {0.01, 0.02, -0.015}};
  const Eigen::Vector3d n = Eigen::Vector3d(0.2, -0.4, -0.9).normalized(), x(0.1, 0.2, 1.3);
  FramePlane plane;
  plane.pi_c = {n, -n.dot(x)};
  plane.centroid_c = x;
  plane.points_c = {x, x + 0.1 * n.unitOrthogonal()};
  plane.edge_points = {{x, {320, 200}}};
  plane.lines_c = {{x, n.unitOrthogonal()}};
  plane.vertices_c = {{x, false, 1e-6 * Eigen::Vector3d(1, 2, 3).asDiagonal().toDenseMatrix()}};
  plane.inverse_depth_covariance = n * n.transpose();
  std::vector<FramePlane> moved{plane};
  MovePlanes(T_ba, moved);
  const FramePlane& there = moved[0];
  for (const Eigen::Vector3d& p : there.points_c) {
    EXPECT_NEAR(SignedDistance(there.pi_c, p), 0.0, 1e-12);
  }
  for (const Eigen::Vector3d& p :
       {there.centroid_c, there.edge_points[0].p_c, there.lines_c[0].P, there.vertices_c[0].p_c,
        there.points_c[0]}) {
    EXPECT_LT((p - T_ba * x).norm(), 1e-12);
  }
  EXPECT_NEAR(there.lines_c[0].V.dot(there.pi_c.n), 0.0, 1e-12);
  EXPECT_EQ(there.edge_points[0].u_px, plane.edge_points[0].u_px);
  // Uncertainties turn with what they are of.
  EXPECT_NEAR(there.pi_c.n.dot(there.inverse_depth_covariance * there.pi_c.n), 1.0, 1e-12);
  EXPECT_NEAR(there.vertices_c[0].covariance_c.trace(), 6e-6, 1e-15);
  EXPECT_FALSE(there.vertices_c[0].covariance_c.isDiagonal(1e-3));
}

TEST(MovePlanes, LeavesAPlaneThatTheOtherCameraWouldSeeFromBehind) {
  FramePlane plane;
  plane.pi_c = {Eigen::Vector3d::UnitY(), 0.001};
  plane.centroid_c = {0, -0.001, 1};
  std::vector<FramePlane> moved{plane};
  MovePlanes({Eigen::Matrix3d::Identity(), {0, 0.003, 0}}, moved);
  EXPECT_EQ(moved[0].pi_c.d, plane.pi_c.d);
  EXPECT_EQ(moved[0].centroid_c, plane.centroid_c);
}

}  // namespace
}  // namespace slam
