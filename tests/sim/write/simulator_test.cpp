#include "sim/write/simulator.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/sensor/calibration_error.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

// The error is the device's: it goes with the camera, wherever that looks.
TEST(Simulator, TakesDepthFromBesideTheColourCameraInTheCamerasOwnAxes) {
  RigOptions exact;
  exact.camera = SmallCamera();
  exact.sensor = SensorKind::kIdeal;
  RigOptions beside = exact;
  beside.sensor.calibration.registration_px = 4;
  const Pose T_cd = RegistrationError(beside.sensor.calibration, beside.device());
  for (const Eigen::Vector3d& eye_w :
       {Eigen::Vector3d(0.2, -1.1, 1.5), Eigen::Vector3d(1.2, 0.3, 1.4)}) {
    const Pose T_wc = LookAt(eye_w, {0, 0, 0.8});
    const cv::Mat1w seen = Simulator(SmallDesk(), beside).Simulate(0, T_wc).depth;
    const cv::Mat1w there = Simulator(SmallDesk(), exact).Simulate(0, T_wc * T_cd).depth;
    EXPECT_EQ(cv::norm(seen, there, cv::NORM_INF), 0.0);
    const cv::Mat1w without = Simulator(SmallDesk(), exact).Simulate(0, T_wc).depth;
    EXPECT_GT(cv::norm(seen, without, cv::NORM_INF), 0.0);
  }
}

}  // namespace
}  // namespace sim
