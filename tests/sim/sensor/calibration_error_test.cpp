#include "sim/sensor/calibration_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/sensor/read_sensor.h"

namespace sim {
namespace {

constexpr int kUnits = 400;

/// Where the depth of what the colour camera sees at (u, v) lies, pixels.
Eigen::Vector2d DepthPixel(const Camera& camera, const Pose& T_dc, double u, double v) {
  return camera.Project(Inverse(T_dc) * camera.Ray(u, v));
}

TEST(RegistrationError, IsAsFarBesideTheColourAsItIsTold) {
  const Camera camera;
  double middle = 0, corner = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::uint64_t device = 1; device <= kUnits; ++device) {
    const Pose T_dc = RegistrationError({.registration_px = 1.5}, device);
    EXPECT_EQ(T_dc.t.norm(), 0);
    EXPECT_LT((T_dc.R * T_dc.R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    const Eigen::Vector2d shift =
        DepthPixel(camera, T_dc, camera.cx, camera.cy) - Eigen::Vector2d(camera.cx, camera.cy);
    middle += shift.squaredNorm();
    corner += std::pow(400 * std::atan2(T_dc.R(1, 0), T_dc.R(0, 0)), 2);
    mean += shift;
  }
  EXPECT_NEAR(std::sqrt(middle / kUnits), 1.5, 0.15);
  // Along the sight it turns the corner, 400 px from the middle, by half of that.
  EXPECT_NEAR(std::sqrt(corner / kUnits), 0.75, 0.1);
  EXPECT_LT((mean / kUnits).norm(), 0.2);  // to all sides
}

TEST(RegistrationError, IsNoneWhenNoneIsAskedFor) {
  EXPECT_EQ(RegistrationError({}, 5).R, Eigen::Matrix3d::Identity());
}

TEST(ToldCamera, ErrsByTheShareThatIsTold) {
  const Camera camera;
  double focal = 0, centre = 0, apart = 0;
  for (std::uint64_t device = 1; device <= kUnits; ++device) {
    const Camera told = ToldCamera(camera, {.intrinsics = 0.003}, device);
    focal += std::pow(told.fx / camera.fx - 1, 2);
    centre += std::pow((told.cy - camera.cy) / camera.fy, 2);
    apart += std::pow(told.fy / told.fx - 1, 2);
    EXPECT_EQ(told.width, camera.width);
  }
  EXPECT_NEAR(std::sqrt(focal / kUnits), 0.003, 0.0003);
  EXPECT_NEAR(std::sqrt(centre / kUnits), 0.003, 0.0003);
  EXPECT_NEAR(std::sqrt(apart / kUnits), 0.0006, 0.0001);  // the axes err together
}

TEST(ToldCamera, IsTheDevicesInAllItsRecordings) {
  const CalibrationError error{.intrinsics = 0.003};
  EXPECT_EQ(ToldCamera({}, error, 3).fx, ToldCamera({}, error, 3).fx);
  EXPECT_NE(ToldCamera({}, error, 3).fx, ToldCamera({}, error, 4).fx);
  EXPECT_EQ(ToldCamera({}, {}, 3).fx, Camera{}.fx);
}

TEST(ToldCamera, PutsTheCentreOffToAllSidesAlike) {
  const Camera camera;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (std::uint64_t device = 1; device <= kUnits; ++device) {
    const Camera told = ToldCamera(camera, {.intrinsics = 0.003}, device);
    const Eigen::Vector2d off((told.cx - camera.cx) / camera.fx,
                              (told.cy - camera.cy) / camera.fy);
    spread += off * off.transpose() / (0.003 * 0.003 * kUnits);
  }
  EXPECT_NEAR(std::sqrt(spread(0, 0)), 1, 0.1);
  EXPECT_NEAR(std::sqrt(spread(1, 1)), 1, 0.1);
  EXPECT_NEAR(spread(0, 1), 0, 0.15);  // three sds of what 400 draws leave of none
}

TEST(ToldCamera, OfADeviceThatTheFileNamesIsTheSameWhateverTheSeed) {
  for (const std::string base : {"kinect1", "azure", "d435"}) {
    const auto told_fx = [&](const std::string& line, std::uint64_t seed) {
      const Sensor sensor =
          ParseSensor("base: " + base + "\nintrinsics_error: 0.003\n" + line, "mine.yaml");
      return ToldCamera({}, sensor.calibration, DeviceOf(sensor.depth, seed)).fx;
    };
    EXPECT_EQ(told_fx("device: 7\n", 1), told_fx("device: 7\n", 2)) << base;
    EXPECT_NE(told_fx("device: 7\n", 1), told_fx("device: 8\n", 1)) << base;
    EXPECT_NE(told_fx("", 1), told_fx("", 2)) << base << ": each seed is a device";
  }
}

}  // namespace
}  // namespace sim
