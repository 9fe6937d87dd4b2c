#include "slam/mapping/point_triangulation.h"

#include <gtest/gtest.h>

#include "slam/mapping/map_points.h"
#include "tests/support/point_world.h"

namespace slam {
namespace {

const Eigen::Vector3d kPoint_w(0.3, -0.2, 2.0);
const Pose kFirst{};
const Pose kSecond{ExpSo3({0.02, -0.05, 0.01}), {-0.2, 0.05, 0.0}};

TEST(Triangulate, MeetsThePointOfTwoExactRays) {
  const Camera camera;
  const auto p_w = Triangulate(camera.Project(kFirst * kPoint_w), kFirst,
                               camera.Project(kSecond * kPoint_w), kSecond, camera, 0.01);
  ASSERT_TRUE(p_w);
  EXPECT_LT((*p_w - kPoint_w).norm(), 1e-10);
}

TEST(Triangulate, RefusesRaysThatAreNearlyParallel) {
  const Camera camera;
  const Eigen::Vector3d far_w(10, 5, 500);
  EXPECT_FALSE(Triangulate(camera.Project(kFirst * far_w), kFirst,
                           camera.Project(kSecond * far_w), kSecond, camera, 0.01));
}

TEST(Triangulate, RefusesRaysThatMeetBehindTheCameras) {
  const Camera camera;
  const Eigen::Vector3d behind_w(0.3, -0.2, -2.0);  // Project mirrors it to the front
  EXPECT_FALSE(Triangulate(camera.Project(kFirst * behind_w), kFirst,
                           camera.Project(kSecond * behind_w), kSecond, camera, 0.01));
}

TEST(TriangulatePoints, MakesPointsOfFeaturesWithoutDepthWhereTheyAre) {
  const PointWorld truth = MakePointWorld(3, 120, 1, 1000);
  PointWorld world = truth;
  for (const MapPoint& point : truth.map.points) {
    if (point.id % 2 == 0) CullPoint(world.map, point.id);
  }
  for (int k = 0; k < 3; ++k) UpdateCovisibility(world.map, k, {});
  const std::size_t before = world.map.points.size();
  const int made = TriangulatePoints(world.map, 2, world.camera, {});
  EXPECT_EQ(world.map.points.size(), before + static_cast<std::size_t>(made));
  EXPECT_GE(made, 20);
  for (std::size_t i = before; i < world.map.points.size(); ++i) {
    const MapPoint& point = world.map.points[i];
    EXPECT_EQ(point.observations.size(), 2u);
    double nearest = 1e9;
    for (const MapPoint& true_point : truth.map.points) {
      nearest = std::min(nearest, (true_point.p_w - point.p_w).norm());
    }
    EXPECT_LT(nearest, 1e-6);
  }
}

}  // namespace
}  // namespace slam
