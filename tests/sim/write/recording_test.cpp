#include "sim/write/recording.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <tuple>

#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

RigOptions RecordedRig(double fps) {
  RigOptions rig;
  rig.camera = Resize(Camera{}, 48, 36);
  rig.camera.fps = fps;
  rig.sensor = SensorKind::kKinect1;
  rig.seed = 3;
  return rig;
}

bool Same(const Pose& a, const Pose& b) { return a.R == b.R && a.t == b.t; }

/// Whether the first of a longer recording asks for the very poses of the shorter.
void ExpectBeginOf(const Recording& longer, const Recording& shorter, const Sensor& sensor) {
  const double half_s = (sensor.exposure.rolling_s + sensor.exposure.shutter_s) / 2;
  const std::vector<double> asked_s{-half_s, 0.0, half_s, sensor.timing.depth_offset_s};
  ASSERT_GT(longer.frames(), shorter.frames());
  for (std::size_t i = 0; i < shorter.shots.size(); ++i) {
    const double time_s = shorter.shots[i].time_s;
    EXPECT_EQ(longer.shots[i].time_s, time_s);
    EXPECT_TRUE(Same(longer.shots[i].T_wc, shorter.shots[i].T_wc)) << i;
    for (const double later_s : asked_s) {
      EXPECT_TRUE(
          Same(PoseAt(longer.path, time_s + later_s), PoseAt(shorter.path, time_s + later_s)))
          << "frame " << i << " of " << shorter.frames() << ", " << later_s << " s later";
    }
  }
}

TEST(PlanRecording, OfMoreFramesBeginsWithThoseOfFewer) {
  const Scene scene = SmallDesk();
  for (const double fps : {5.0, 30.0, 44.0, 60.0, 120.0, 333.0}) {
    SCOPED_TRACE(fps);
    for (const auto& [rolling_ms, shutter_ms, depth_ms] : {std::tuple(30.0, 15.0, 15.0),
                                                           {0.0, 0.0, 20.0},
                                                           {100.0, 0.0, 0.0},
                                                           {0.0, 250.0, 0.0},
                                                           {-40.0, 10.0, 5.0},
                                                           {1000.0 / fps, 1000.0 / fps, 0.0}}) {
      RigOptions rig = RecordedRig(fps);
      rig.sensor.exposure.rolling_s = rolling_ms / 1000;
      rig.sensor.exposure.shutter_s = shutter_ms / 1000;
      rig.sensor.timing.depth_offset_s = depth_ms / 1000;
      rig.sensor.timing.drop_ratio = 0;  // so that the last frame is there
      ExpectBeginOf(PlanRecording(scene, rig, 25), PlanRecording(scene, rig, 4), rig.sensor);
    }
  }
}

// Nothing more is asked of the motion where a frame's own time was enough: no scene whose way is
// narrow is refused for the sake of a pose that no frame needs.
TEST(PlanRecording, FollowsThePathOneFrameBeyondTheLastAtThirtyHertz) {
  const Recording recording = PlanRecording(SmallDesk(), RecordedRig(30), 5);
  EXPECT_EQ(recording.path.size(), 5u * 8 + 1);
}

TEST(PlanRecording, LeavesAFrameItsBytesWhenMoreFollow) {
  RigOptions rig = RecordedRig(120);
  rig.sensor.timing.drop_ratio = 0;
  const Scene scene = SmallDesk();
  const Simulator simulator(scene, rig);
  const Recording shorter = PlanRecording(scene, rig, 3), longer = PlanRecording(scene, rig, 9);
  for (int i = 0; i < 3; ++i) {
    const SimulatedFrame a = Record(simulator, shorter, i), b = Record(simulator, longer, i);
    EXPECT_EQ(cv::norm(a.colour, b.colour, cv::NORM_INF), 0.0) << i;
    EXPECT_EQ(cv::norm(a.depth, b.depth, cv::NORM_INF), 0.0) << i;
  }
}

// The device hands out the same image twice: its noise, too, is there again.
TEST(Record, ShowsTheVeryImagesAgainWhereAFrameIsRepeated) {
  RigOptions rig = RecordedRig(30);
  rig.sensor.timing.drop_ratio = 0;
  rig.sensor.timing.repeat_ratio = 0.4;
  const Scene scene = SmallDesk();
  const Simulator simulator(scene, rig);
  const Recording recording = PlanRecording(scene, rig, 12);
  int repeated = 0;
  SimulatedFrame before = Record(simulator, recording, 0);
  for (int i = 1; i < recording.frames(); ++i) {
    const SimulatedFrame now = Record(simulator, recording, i);
    const bool again = recording.shots[static_cast<std::size_t>(i)].exposed != i;
    EXPECT_EQ(cv::norm(now.colour, before.colour, cv::NORM_INF) == 0.0, again) << i;
    EXPECT_EQ(cv::norm(now.depth, before.depth, cv::NORM_INF) == 0.0, again) << i;
    repeated += again ? 1 : 0;
    before = now;
  }
  EXPECT_GT(repeated, 1);
  EXPECT_LT(repeated, recording.frames() - 2);
}

}  // namespace
}  // namespace sim
