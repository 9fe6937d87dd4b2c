#include "eval/export/silhouette.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <utility>

namespace eval {
namespace {

TEST(BoxSilhouette, CountsAsManyPixelsBeyondEachBorder) {
  Camera camera;
  camera.width = 160, camera.height = 120;
  camera.fx = camera.fy = 150, camera.cx = 79.5, camera.cy = 59.5;
  constexpr double kPixel_m = 2.0 / 150;  // at 2 m
  const Eigen::Vector3d board(16 * kPixel_m, 16 * kPixel_m, 1e-6);
  for (const auto& [right_px, down_px] :
       {std::pair(0, 0), {80, 0}, {-80, 0}, {0, 60}, {0, -60}, {200, 0}, {0, 150}, {0, -150}}) {
    Pose T_co;
    T_co.t = {right_px * kPixel_m, down_px * kPixel_m, 2.0};
    const Silhouette found = BoxSilhouette(camera, T_co, board);
    EXPECT_EQ(found.all.count, 256) << right_px << ", " << down_px;
    EXPECT_EQ(found.all.x0, 72 + right_px);
    EXPECT_EQ(found.all.y1, 67 + down_px);
    const bool inside = right_px == 0 && down_px == 0;
    const bool cut = !inside && std::abs(right_px) <= 80 && std::abs(down_px) <= 60;
    EXPECT_EQ(cv::countNonZero(found.mask), inside ? 256 : cut ? 128 : 0);
  }
}

}  // namespace
}  // namespace eval
