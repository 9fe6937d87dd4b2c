#include "slam/segment/pixels/depth_grid.h"

#include <gtest/gtest.h>

#include "slam/geometry/camera.h"
#include "slam/geometry/sensor_model.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

// Eleven pixels: eight at once, and those that are left.
TEST(DepthGrid, WeighsEveryDepthByTheNoiseThatItsSensorHasThere) {
  Camera camera;
  camera.width = 11, camera.height = 1;
  cv::Mat1f depth_m(camera.height, camera.width);
  for (int u = 0; u < camera.width; ++u) depth_m(0, u) = 0.3f + 0.5f * static_cast<float>(u);
  for (const DepthSensor sensor :
       {DepthSensor::kKinect1, DepthSensor::kAzure, DepthSensor::kD435}) {
    const DepthNoise noise = ModelOf(sensor).noise;
    const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), noise, 10.0);
    for (int u = 0; u < camera.width; ++u) {
      const auto i = static_cast<std::size_t>(u);
      const double z_m = static_cast<double>(depth_m(0, u));
      EXPECT_NEAR(static_cast<double>(grid.q[i]) * z_m, 1.0, 1e-6);
      EXPECT_NEAR(static_cast<double>(grid.g[i]) * noise.Sigma(z_m) / (z_m * z_m), 1.0, 1e-5)
          << DepthSensorNames()[static_cast<std::size_t>(sensor)] << " at " << z_m;
    }
  }
}

}  // namespace
}  // namespace slam
