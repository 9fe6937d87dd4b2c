#include "slam/mapping/plane_motion.h"

#include <gmock/gmock.h>

#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

TEST(PlaneMotion, APlaneMovesWithAllThatItHas) {
  const Pose T{ExpSo3({0.3, -0.2, 0.5}), {0.4, -1.0, 2.0}};
  MapPlane plane;
  const Plane desk{Eigen::Vector3d(0.1, 0.2, 1).normalized(), -0.7};
  AddObservation(plane.estimate, desk, {0.3, 0.1, 0.6}, 0.01, 0.002, 1.0);
  AddObservation(plane.estimate, desk, {-0.3, 0.2, 0.7}, 0.01, 0.002, 1.0);
  plane.pi_w = plane.estimate.Mean();
  for (const Eigen::Vector3d& x : {Eigen::Vector3d{0.1, 0.2, 0.3}, Eigen::Vector3d{1, 0, 0}}) {
    plane.points_w.push_back(ProjectOnto(plane.pi_w, x));
  }
  plane.hull_w = plane.vertices_w = plane.points_w;
  const MapPlane before = plane;
  plane.parts.emplace_back();
  plane.parts[0].surface = plane.parts[0].rest = before;
  plane.supposed.emplace_back();
  plane.supposed[0].pi_w = before.pi_w;
  plane.supposed[0].estimate = before.estimate;
  MovePlane(plane, T);
  for (const MapPlane* moved : {&plane.parts[0].surface, &plane.parts[0].rest}) {
    EXPECT_THAT(moved->pi_w.n, VectorNear(plane.pi_w.n, 1e-12));
    EXPECT_NEAR(moved->pi_w.d, plane.pi_w.d, 1e-12);
    EXPECT_THAT(moved->points_w[1], VectorNear(plane.points_w[1], 1e-12));
    EXPECT_THAT(moved->estimate.Mean().n, VectorNear(plane.pi_w.n, 1e-12));
  }
  EXPECT_NEAR(plane.supposed[0].estimate.Mean().d, plane.pi_w.d, 1e-12);
  EXPECT_NEAR(plane.supposed[0].pi_w.d, plane.pi_w.d, 1e-12);
  EXPECT_THAT(plane.estimate.Mean().n, VectorNear(plane.pi_w.n, 1e-12));
  EXPECT_NEAR(plane.estimate.Mean().d, plane.pi_w.d, 1e-12);
  EXPECT_THAT(plane.pi_w.n, VectorNear(T.R * before.pi_w.n, 1e-12));
  for (const auto* points : {&plane.points_w, &plane.hull_w, &plane.vertices_w}) {
    for (std::size_t i = 0; i < points->size(); ++i) {
      EXPECT_THAT((*points)[i], VectorNear(T * before.points_w[i], 1e-12));
      EXPECT_NEAR(SignedDistance(plane.pi_w, (*points)[i]), 0, 1e-12);
    }
  }
}

TEST(PlaneMotion, LaysOnePlaneOnAnotherNearAPointAndTurnsNoFartherThanItMust) {
  const Plane from{Eigen::Vector3d(0.1, 0.2, 1).normalized(), -0.7};
  const Plane to{Eigen::Vector3d(0.15, 0.1, 1).normalized(), -0.69};
  const Eigen::Vector3d x_w(0.4, -3, 5);
  const Pose T_new_old = MotionBetween(from, to, x_w);
  EXPECT_THAT(Transform(T_new_old, from), PlaneNear(to, 1e-12, 1e-12));
  EXPECT_NEAR(RotationAngle(T_new_old, Pose{}), Angle(from.n, to.n), 1e-7);
  EXPECT_THAT(Eigen::Vector3d(T_new_old * ProjectOnto(from, x_w)),
              VectorNear(ProjectOnto(to, x_w), 1e-12));
  EXPECT_THAT(MotionBetween(from, from, x_w), PoseNear(Pose{}, 1e-7, 1e-12));
}

}  // namespace
}  // namespace slam
