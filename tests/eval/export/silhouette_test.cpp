#include "eval/export/silhouette.h"

#include <gtest/gtest.h>

#include <cmath>
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

// A floor 0.45 m below the camera, from 2 m ahead to 2 m behind it and 1 m to either side: the
// pixels whose rays come down on it in time, also far below the image.
TEST(BoxSilhouette, IsWholeThoughTheBoxReachesBehindTheCamera) {
  Camera camera;
  camera.width = 160, camera.height = 120;
  camera.fx = camera.fy = 150, camera.cx = 79.5, camera.cy = 59.5;
  Pose T_co;
  T_co.t = {0.0, 0.5, 0.0};
  const Silhouette found = BoxSilhouette(camera, T_co, {2.0, 0.1, 4.0});
  int everywhere = 0, in_image = 0;
  for (int v = -camera.height; v < 2 * camera.height; ++v) {
    for (int u = -camera.width; u < 2 * camera.width; ++u) {
      const double down = (v - camera.cy) / camera.fy, right = (u - camera.cx) / camera.fx;
      const double z_m = 0.45 / down;  // where the ray meets the floor's upper side
      if (!(down > 0) || z_m > 2.0 || std::abs(right) * z_m > 1.0) continue;
      ++everywhere;
      in_image += u >= 0 && u < camera.width && v >= 0 && v < camera.height ? 1 : 0;
    }
  }
  EXPECT_EQ(found.all.count, everywhere);
  EXPECT_EQ(cv::countNonZero(found.mask), in_image);
  EXPECT_EQ(found.all.y1, 2 * camera.height - 1);
}

}  // namespace
}  // namespace eval
