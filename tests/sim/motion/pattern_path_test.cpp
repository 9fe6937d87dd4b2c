#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/angle.h"
#include "sim/motion/trajectory.h"
#include "sim/scene/geometry.h"
#include "tests/sim/support/sim_worlds.h"
#include "tests/support/trajectory_means.h"

namespace sim {
namespace {

TEST(PatternPath, AsksOnlyTheLoopForItsStations) {
  Scene scene;
  scene.motion.preset = "orbit";
  scene.motion.target_w = {0, 0, 0.7};
  scene.motion.distance_min_m = 0.4;
  scene.motion.distance_max_m = 3;
  scene.objects = {BoxObject(1, "floor", Role::kStructure, {0, 0, -0.05}, {8, 8, 0.1}),
                   BoxObject(2, "box", Role::kRegular, {0, -1.2, 1.6}, {0.8, 0.3, 0.3})};
  Scene with_stations = scene;
  for (const double x : {0.0, 1.0}) {
    with_stations.motion.stations.push_back({{x, -1, 1.2}, {0, 0, 0.75}});
    with_stations.motion.stations.push_back({{1 - x, -2, 1.2}, {0, 0, 0.75}});
  }
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {  // most of their first orbits are not free
    EXPECT_EQ(MakeTrajectory(with_stations, 2, 30, seed).back().T_wc.t,
              MakeTrajectory(scene, 2, 30, seed).back().T_wc.t);
  }
}

TEST(PatternPath, CutsNoCornerIntoWhatItGoesRoundHoweverFastItIs) {
  Scene scene;
  Motion& motion = scene.motion;
  motion.preset = "orbit";
  motion.speed_m_s = 3;
  motion.turn_deg_s = 120;
  motion.target_w = {0, 0, 1};
  motion.target_spread_m = 0.1;
  motion.distance_min_m = motion.distance_max_m = 1.6;
  motion.azimuth_min_rad = -M_PI, motion.azimuth_max_rad = M_PI;
  motion.pitch_min_rad = 0, motion.pitch_max_rad = DegToRad(10);
  scene.objects = {BoxObject(1, "floor", Role::kStructure, {0, 0, -0.05}, {8, 8, 0.1}),
                   BoxObject(2, "box", Role::kRegular, {0, 0, 0.9}, {1.92, 1.92, 1.8})};
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const auto path = MakeTrajectory(scene, 400, 30, seed);
    for (const TimedPose& pose : path) {
      // Between two of its checks it may come a little nearer.
      ASSERT_GT(DistanceToBox(scene.objects[1], pose.T_wc.t), 0.149) << pose.timestamp_s;
    }
    EXPECT_GT(MeansOf(path).speed_m_s, 0.3) << "it waits for ever";
  }
}

}  // namespace
}  // namespace sim
