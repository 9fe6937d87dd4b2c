#include "slam/run/frame_extractor.h"

#include <gtest/gtest.h>

#include "tests/support/plane_world.h"

namespace slam {
namespace {

// What is learnt of the sensor is learnt from what it measured, however it is told meanwhile.
TEST(FrameExtractor, KeepsDepthAsMeasuredBesideTheStraightened) {
  const Camera camera = SmallCamera();
  FrameExtractor extractor(camera, PixelRays(camera), Config{}, true, nullptr, 1);
  const cv::Mat1f raw_m(camera.height, camera.width, 1.25f);
  Frame frame;
  frame.depth_m = raw_m.clone();
  frame.gray = cv::Mat1b(raw_m.size(), std::uint8_t{100});
  ModuleTimes times;
  const Straightening straightening{cv::Mat1f(raw_m.size(), 1.0f / 1.02f - 1.0f),
                                    BendLaw::kDepth, 0.002};
  extractor.Extract(straightening, cv::Mat3b(raw_m.size()), frame, times);
  EXPECT_EQ(cv::norm(frame.measured.depth_m, raw_m, cv::NORM_INF), 0.0);
  EXPECT_LT(cv::norm(frame.depth_m, 1.02 * raw_m, cv::NORM_INF), 1e-6);
  ASSERT_EQ(frame.planes.size(), 1u);
  EXPECT_NEAR(frame.planes[0].pi_c.d, 1.02 * 1.25, 1e-4);
  // The plane is flat; what a warp leaves counts all the same.
  EXPECT_EQ(frame.bend_ratio, 0.002);
}

}  // namespace
}  // namespace slam
