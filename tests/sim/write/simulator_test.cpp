#include "sim/write/simulator.h"

#include <gtest/gtest.h>

#include <cmath>
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

// A board comes nearer while the camera rests: depth that is taken later shows it nearer.
TEST(Simulator, TakesDepthOfWhatMovesWhenItIsTaken) {
  RigOptions exact;
  exact.camera = SmallCamera();
  exact.sensor = SensorKind::kIdeal;
  Scene scene = OneBoard(2.0);
  Object& board = scene.objects[0];
  board.way = {{0.0, board.center_w, 0}, {1.0, board.center_w - Eigen::Vector3d::UnitY(), 0}};
  Shot shot;
  shot.T_wc = LookAlongY();
  shot.time_s = shot.colour_stamp_s = 0.5;
  for (const double delay_s : {-0.02, 0.0, 0.015}) {
    shot.depth_stamp_s = shot.colour_stamp_s + delay_s;
    const SimulatedFrame frame =
        Simulator(scene, exact).Simulate(0, shot, [&](double) { return shot.T_wc; });
    EXPECT_NEAR(frame.depth(60, 80) / exact.camera.depth_factor, 1.5 - delay_s, 0.0002)
        << delay_s;
    // The truth is that of colour.
    ASSERT_TRUE(frame.truth.objects.at(0).T_wo.has_value());
    EXPECT_NEAR(frame.truth.objects[0].T_wo->t.y(), board.center_w.y() - 0.5, 1e-12);
  }
}

// A photograph of one evenly lit board is as bright as its gain says.
TEST(Simulator, DriftsInExposureAsTheSeedAndTheTimeSay) {
  Scene scene = OneBoard(1.0, 20.0, Print::kPlain);
  for (Material& face : scene.objects[0].faces) face.colour = {0.15, 0.15, 0.15};
  RigOptions rig;
  rig.camera = Resize(Camera{}, 32, 24);
  rig.sensor = SensorKind::kIdeal;
  rig.sensor.exposure.drift_stops = 1.0;
  const auto light = [&](std::uint64_t seed, double time_s) {
    rig.seed = seed;
    Shot shot;
    shot.T_wc = LookAlongY();
    shot.time_s = shot.colour_stamp_s = shot.depth_stamp_s = time_s;
    const cv::Mat3b colour =
        Simulator(scene, rig).Simulate(0, shot, [&](double) { return shot.T_wc; }).colour;
    return std::pow(cv::mean(colour)[1] / 255, 2.2);
  };
  const double usual = light(3, 1.0) / ExposureGain(rig.sensor.exposure, 3, 1.0);
  for (const std::uint64_t seed : {3U, 4U, 5U}) {
    for (const double time_s : {0.0, 2.2}) {
      const double gain = ExposureGain(rig.sensor.exposure, seed, time_s);
      EXPECT_NEAR(light(seed, time_s) / usual, gain, 0.04 * gain) << seed << ", " << time_s;
    }
  }
}

}  // namespace
}  // namespace sim
