#include "sim/camera/camera.h"

#include <gtest/gtest.h>

namespace sim {
namespace {

constexpr double kRoundOff_px = 1e-9;

TEST(ResizedCamera, KeepsTheRaysOfTheImageBorders) {
  const Camera large, small = Resize(large, 160, 120);
  const Eigen::Vector3d low = large.Ray(-0.5, -0.5), high = large.Ray(639.5, 479.5);
  EXPECT_NEAR((small.Ray(-0.5, -0.5) - low).norm(), 0, kRoundOff_px);
  EXPECT_NEAR((small.Ray(159.5, 119.5) - high).norm(), 0, kRoundOff_px);
}

TEST(ResizedCamera, ProjectsItsOwnRaysBack) {
  const Camera camera = Resize(Camera{}, 320, 200);
  EXPECT_NEAR((camera.Project(3.0 * camera.Ray(17, 41)) - Eigen::Vector2d(17, 41)).norm(), 0,
              kRoundOff_px);
}

TEST(ResizedCamera, RefusesAnImageTooSmallToHoldAnything) {
  EXPECT_THROW(Resize(Camera{}, 15, 120), std::invalid_argument);
  EXPECT_THROW(Resize(Camera{}, 160, -1), std::invalid_argument);
}

TEST(CameraYaml, PrintsEveryDigit) {
  Camera camera;
  camera.fx = 1.0 / 3.0;
  const std::string text = CameraYaml(camera);
  const std::size_t at = text.find("fx: ") + 4;
  EXPECT_EQ(std::stod(text.substr(at)), 1.0 / 3.0);
  EXPECT_NE(text.find("model: pinhole\nwidth: 640\nheight: 480\n"), std::string::npos);
}

}  // namespace
}  // namespace sim
