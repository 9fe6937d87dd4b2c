#include "slam/segment/extraction_config.h"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "slam/segment/plane_segments.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// Depth of a stereo camera: disparity errors of 0.08 px with 70 % of their variance smooth
/// over windows of 7 x 7 pixels.
cv::Mat1f AddStereoNoise(const cv::Mat1f& depth_m, std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat1f fine(depth_m.size()), smooth(depth_m.size());
  random.fill(fine, cv::RNG::NORMAL, 0.0, 0.08 * std::sqrt(0.3));
  random.fill(smooth, cv::RNG::NORMAL, 0.0, 0.08 * std::sqrt(0.7) * 7.0);
  cv::blur(smooth, smooth, {7, 7});
  cv::Mat1f noisy(depth_m.size());
  for (int v = 0; v < noisy.rows; ++v) {
    for (int u = 0; u < noisy.cols; ++u) {
      const float z = depth_m(v, u);
      const float disparity = z > 0 ? 21.5645f / z + fine(v, u) + smooth(v, u) : 0.0f;
      noisy(v, u) = disparity > 0 ? 21.5645f / disparity : 0.0f;
    }
  }
  return noisy;
}

TEST(ExtractionConfig, KeepsADeskWholeAndABookApartInStereoDepth) {
  closed_form::World world = closed_form::Desk();
  closed_form::PutOnDesk(world, 0.0, 0.0, {0.2, 0.25, 0.04}, 0.3, "book");
  const Camera camera;
  const Pose T_cw = closed_form::LookAt({0.0, 0.0, 1.0}, {0, 0, 0});
  const closed_form::View view = closed_form::Render(world, camera, T_cw);
  const auto planes = [&](DepthSensor sensor) {
    Frame frame = closed_form::MakeFrame(AddStereoNoise(view.depth_m, 5));
    ExtractPlanes(frame, PixelRays(camera), ExtractionFor(sensor), ModelOf(sensor));
    return frame.planes.size();
  };
  EXPECT_EQ(planes(DepthSensor::kD435), 2u);
}

// Time of flight errs by a wave of 2 mm over the distance: it lifts one half of a wall and lowers
// the other. A first Kinect has no wave, and halves that are as far apart are two.
TEST(ExtractionConfig, ReunitesTheHalvesOfAWallThatTheWaveOfTimeOfFlightSetsApart) {
  const Camera camera;
  cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  const int middle = camera.width / 2;
  depth_m.colRange(0, middle) += 0.002f;
  depth_m.colRange(middle, camera.width) -= 0.002f;
  depth_m.colRange(middle - 16, middle + 16) = 0.8f;  // a post in front
  const auto planes = [&](DepthSensor sensor) {
    Frame frame = closed_form::MakeFrame(depth_m);
    ExtractPlanes(frame, PixelRays(camera), ExtractionFor(sensor), ModelOf(sensor));
    return frame.planes.size();
  };
  EXPECT_EQ(planes(DepthSensor::kAzure), 2u);
  EXPECT_EQ(planes(DepthSensor::kKinect1), 3u);
}

}  // namespace
}  // namespace slam
