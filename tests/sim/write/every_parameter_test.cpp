// What a file may say of a sensor reaches what is recorded.
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "io/input_error.h"
#include "sim/sensor/read_sensor.h"
#include "sim/write/recording.h"
#include "sim/write/sequence_text.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

/// A corner of a floor and a wall with a lamp, a black screen and a thin board before the wall.
Scene LampScreenAndBoard() {
  Scene scene;
  scene.objects = {
      BoxObject(1, "floor", Role::kStructure, {0, 0, -0.05}, {5, 5, 0.1}, Print::kPlain),
      BoxObject(2, "wall", Role::kStructure, {0, 1, 1.25}, {5, 0.1, 2.5}, Print::kPlain),
      BoxObject(3, "tv", Role::kRegular, {-0.1, 0, 0.02}, {0.9, 0.7, 0.04}, Print::kScreen),
      BoxObject(4, "board", Role::kRegular, {0.35, 0.3, 0.4}, {0.2, 0.02, 0.8}, Print::kPlain)};
  Light lamp;
  lamp.kind = LightKind::kLamp;
  lamp.center_w = {0, 0.7, 1.6};
  lamp.intensity = 1.0;
  scene.lights = {lamp};
  return scene;
}

/// All that three frames of it hold, as text.
std::string Recorded(const Sensor& sensor) {
  static const Scene scene = LampScreenAndBoard();
  RigOptions rig;
  rig.camera = Resize(Camera{}, 80, 60);
  rig.sensor = sensor;
  rig.detector = DetectorKind::kNone;
  rig.seed = 5;
  std::vector<TimedPose> way;
  for (int i = 0; i < 3; ++i) {
    way.push_back({i / 30.0, LookAt({0.05 + 0.02 * i, -0.75 + 0.01 * i, 0.8}, {0, 0.2, 0.2})});
  }
  const Recording recording = PlanRecording(way, {}, rig);
  const Simulator simulator(scene, rig);
  std::string all = CameraYaml(rig.CameraAsTold());
  for (int i = 0; i < recording.frames(); ++i) {
    const Shot& shot = recording.shots[static_cast<std::size_t>(i)];
    const SimulatedFrame frame = Record(simulator, recording, i);
    all += TimeText(shot.colour_stamp_s) + TimeText(shot.depth_stamp_s);
    all.append(frame.colour.ptr<char>(), frame.colour.total() * frame.colour.elemSize());
    all.append(frame.depth.ptr<char>(), frame.depth.total() * frame.depth.elemSize());
  }
  return all;
}

/// Values of a parameter that a file may give instead; smaller and larger ones.
std::vector<double> Others(const SensorParameter& parameter) {
  const double value = parameter.value;
  std::vector<double> others;
  for (const double other :
       {0.5 * value, 2 * value, value + 2, parameter.high, parameter.low, 0.5, 1.0, 5.0, 0.3}) {
    if (other != value && other >= parameter.low && other <= parameter.high)
      others.push_back(other);
  }
  return others;
}

/// Of colour, exposure, timing and calibration: asked of one sensor.
bool IsOfEverySensor(const std::string& key) {
  const std::vector<SensorParameter> common = Parameters(SensorKind::kIdeal);
  return std::any_of(common.begin(), common.end(),
                     [&](const SensorParameter& one) { return one.key == key; });
}

class EverySensorParameter : public testing::TestWithParam<const char*> {};

TEST_P(EverySensorParameter, ChangesWhatIsRecorded) {
  const std::string base = GetParam();
  const std::string usual = Recorded(ParseSensor(base, "mine.yaml"));
  EXPECT_EQ(Recorded(ParseSensor(base, "mine.yaml")), usual);
  for (const SensorParameter& parameter : Parameters(ParseSensor(base, "mine.yaml"))) {
    const std::string& key = parameter.key;
    if (key.starts_with("lens_")) continue;  // what it bends is the camera that a rig is given
    if (IsOfEverySensor(key) && !base.starts_with("base: ideal")) continue;
    bool changes = false;
    for (const double other : Others(parameter)) {
      std::string text = base;
      if (const auto at = text.find(key + ":"); at != std::string::npos)
        text.erase(at, text.find('\n', at) + 1 - at);
      try {
        const Sensor sensor =
            ParseSensor(text + key + ": " + std::to_string(other) + "\n", "mine.yaml");
        changes = Recorded(sensor) != usual;
      } catch (const io::InputError&) {
        continue;  // half a window, or a range that leaves no depth
      }
      if (changes) break;
    }
    EXPECT_TRUE(changes) << key << " of\n" << base;
  }
}

// With what other parameters say more of.
INSTANTIATE_TEST_SUITE_P(
    Bases, EverySensorParameter,
    testing::Values("base: ideal\n", "base: kinect1\n",
                    "base: azure\nbend_rms: 0.004\nmin_return_per_m2: 0.012\n"
                    "return_spread_ln: 0.2\nmirror_spot_deg: 3\n",
                    "base: d435\nbend_rms: 0.004\nmax_depth_m: 2\n"),
    [](const auto& base) {
      return std::string(base.param).substr(6, std::string(base.param).find('\n') - 6);
    });

}  // namespace
}  // namespace sim
