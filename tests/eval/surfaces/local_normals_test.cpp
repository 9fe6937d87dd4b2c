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

// Two means of a window's halves are off by noise that grows with the square of the distance, over a
// length that grows with the distance: far away a normal tells the less.
TEST(SpeaksAgainst, ANormalOnlyAsFarAsNoiseLeavesOneThere) {
  constexpr int kCols = 320, kRows = 240, kRadius = 4;  // 7 px of 640
  constexpr double kFocal_px = 280, kNoise_per_m = 0.0016;
  cv::Mat2d rays(kRows, kCols);
  for (int v = 0; v < kRows; ++v) {
    for (int u = 0; u < kCols; ++u)
      rays(v, u) = {(u - 159.5) / kFocal_px, (v - 119.5) / kFocal_px};
  }
  for (const double z_m : {1.0, 2.0, 4.0, 8.0}) {
    const LocalNormals local = FitLocalNormals(cv::Mat1f(kRows, kCols, float(z_m)), rays, 1);
    const double slope = kNoise_per_m * z_m * z_m / (z_m * kRadius / kFocal_px);
    const double limit_rad = std::max(0.52, 3 * slope / 2);  // of four parts of a window
    for (const double share : {0.97, 1.03}) {
      for (const double way : {0.0, 1.0, 2.5}) {
        const double tilt = share * limit_rad;
        const Eigen::Vector3d n_c(std::sin(tilt) * std::cos(way),
                                  std::sin(tilt) * std::sin(way), -std::cos(tilt));
        EXPECT_EQ(SpeaksAgainst(local, 120, 160, z_m, n_c, kNoise_per_m), share > 1)
            << z_m << " m, " << tilt << " rad, " << way;
      }
    }
  }
}

}  // namespace
}  // namespace eval
