#include "sim/truth/silhouette.h"

#include <gtest/gtest.h>

namespace sim {
namespace {

/// A sheet 1 m before the camera, from -half to half, in two triangles.
std::vector<Triangle> Sheet(double half_x_m, double half_y_m) {
  const auto corner = [&](double x, double y) {
    return Eigen::Vector3d(x * half_x_m, y * half_y_m, 1);
  };
  Triangle lower, upper;
  lower.corners_w = {corner(-1, -1), corner(1, -1), corner(1, 1)};
  upper.corners_w = {corner(-1, -1), corner(1, 1), corner(-1, 1)};
  return {lower, upper};
}

TEST(ProjectedBox, GoesFromCornerToCornerWithoutALens) {
  const Camera camera;
  const auto box = ProjectedBox(Sheet(0.5, 0.3), Pose{}, camera);
  ASSERT_TRUE(box.has_value());
  EXPECT_NEAR(box->x0, camera.cx - 0.5 * camera.fx, 1e-9);
  EXPECT_NEAR(box->x1, camera.cx + 0.5 * camera.fx, 1e-9);
  EXPECT_NEAR(box->y0, camera.cy - 0.3 * camera.fy, 1e-9);
  EXPECT_NEAR(box->y1, camera.cy + 0.3 * camera.fy, 1e-9);
}

/// A barrel draws corners inwards, by the square of how far out they are: the middles of the
/// edges reach farthest.
TEST(ProjectedBox, ReachesAsFarAsAnEdgeThatTheLensBends) {
  Camera camera;
  camera.lens.k1 = -0.2;
  const auto box = ProjectedBox(Sheet(0.5, 0.3), Pose{}, camera);
  ASSERT_TRUE(box.has_value());
  const double x = 0.5 * (1 - 0.2 * 0.25), y = 0.3 * (1 - 0.2 * 0.09);
  EXPECT_NEAR(box->x0, camera.cx - x * camera.fx, 1e-9);
  EXPECT_NEAR(box->x1, camera.cx + x * camera.fx, 1e-9);
  EXPECT_NEAR(box->y0, camera.cy - y * camera.fy, 1e-9);
  EXPECT_NEAR(box->y1, camera.cy + y * camera.fy, 1e-9);
}

}  // namespace
}  // namespace sim
