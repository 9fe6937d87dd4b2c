#include "eval/surfaces/local_normals.h"

#include <gtest/gtest.h>

#include <cmath>

namespace eval {
namespace {

// The right wall of a corridor, 1 m off, from a camera that looks along it or 5 degrees to the
// left: rays at the right of the image still meet it from the front.
TEST(FitLocalNormals, SeesAWallThatFacesAwayFromTheAxisAndNotFromTheRay) {
  constexpr int kCols = 320, kRows = 240, kSeen = 290;
  constexpr double kFocal_px = 280;
  for (const double turn_rad : {0.0, 0.087}) {
    const Eigen::Vector3d n_c(-std::cos(turn_rad), 0, std::sin(turn_rad));
    cv::Mat2d rays(kRows, kCols);
    cv::Mat1f depth_m(kRows, kCols, 0.0F);
    for (int v = 0; v < kRows; ++v) {
      for (int u = 0; u < kCols; ++u) {
        const Eigen::Vector3d ray((u - 159.5) / kFocal_px, (v - 119.5) / kFocal_px, 1);
        rays(v, u) = {ray.x(), ray.y()};
        const double z_m = -1 / n_c.dot(ray);
        if (z_m > 0 && z_m < 6) depth_m(v, u) = float(z_m);
      }
    }
    const LocalNormals local = FitLocalNormals(depth_m, rays, 1);
    ASSERT_GT(depth_m(kRows / 2, kSeen), 0);
    ASSERT_TRUE(IsSmooth(local, kRows / 2, kSeen, 1e-3)) << turn_rad;
    const cv::Vec3f& n = local.normals_c(kRows / 2, kSeen);
    EXPECT_LT((Eigen::Vector3d(n[0], n[1], n[2]) - n_c).norm(), 1e-3) << turn_rad;
  }
}

}  // namespace
}  // namespace eval
