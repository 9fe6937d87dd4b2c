#include "app/bench/bench_planes_score.h"

#include <gtest/gtest.h>

#include "tests/support/cameras.h"

namespace app {
namespace {

/// Whether a true plane counts of which this share of the image is measured, in rows from above.
bool CountsWithShare(double share, const slam::Camera& camera) {
  eval::TruthPlane plane;
  plane.id = 7;
  eval::SeenPlane seen;
  seen.plane = &plane;
  seen.pixels = camera.width * camera.height;
  seen.counted = true;
  eval::TrueFrame truth;
  truth.planes = {seen};
  truth.plane_ids = cv::Mat1w(camera.height, camera.width, std::uint16_t{7});
  cv::Mat1f depth_m(camera.height, camera.width, 0.0f);
  for (int i = 0; i < share * camera.width * camera.height; ++i)
    depth_m(i / camera.width, i % camera.width) = 1.0f;
  LeaveOutUnmeasured(depth_m, camera, truth);
  return truth.planes[0].counted;
}

// The rule is told for 640 x 480: of a larger or smaller image of the same view it asks the same
// share.
TEST(LeaveOutUnmeasured, AsksForTheSameShareOfAnImageOfAnySize) {
  constexpr double kLeast = eval::kMinPixels / (640.0 * 480.0);
  for (const int width : {160, 320, 640, 1280}) {
    const slam::Camera camera = slam::CameraOfSize(width, width * 3 / 4);
    EXPECT_TRUE(CountsWithShare(1.1 * kLeast, camera)) << width;
    EXPECT_FALSE(CountsWithShare(0.9 * kLeast, camera)) << width;
  }
}

}  // namespace
}  // namespace app
