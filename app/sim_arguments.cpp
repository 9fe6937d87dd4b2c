#include "app/sim_arguments.h"

#include <cmath>
#include <filesystem>

#include "io/sha256.h"
#include "sim/motion/recorded.h"
#include "sim/scene/names.h"
#include "sim/scene/read_scene.h"
#include "sim/sensor/read_sensor.h"
#include "version.h"

namespace app {

sim::Scene SceneOf(const SimArguments& arguments) {
  sim::Scene scene = sim::ReadScene(arguments.scene);
  if (arguments.motion) {
    // Another way of moving has its own pace and goes round nothing.
    scene.motion.preset = *arguments.motion;
    scene.motion.speed_m_s = scene.motion.turn_deg_s = 0;
    if (*arguments.motion != "loop") scene.motion.stations.clear();
  }
  if (arguments.speed_m_s) scene.motion.speed_m_s = *arguments.speed_m_s;
  if (arguments.turn_deg_s) scene.motion.turn_deg_s = *arguments.turn_deg_s;
  return scene;
}

sim::SequenceOptions OptionsOf(const SimArguments& arguments, const sim::Scene& scene) {
  sim::Capture capture = scene.capture.value_or(sim::Capture{});
  if (arguments.fps) capture.fps = *arguments.fps;
  sim::SequenceOptions options;
  sim::RigOptions& rig = options.rig;
  const std::vector<double>& k = arguments.lens;
  if (!k.empty()) capture.distortion = {k[0], k[1], k[2], k[3], k[4]};
  rig.camera = sim::Resize(sim::CameraOf(capture), arguments.width.value_or(capture.width),
                           arguments.height.value_or(capture.height));
  rig.sensor = sim::SensorByName(arguments.sensor.value_or(capture.sensor));
  rig.exposure.shutter_s = 1e-3 * arguments.shutter_ms;
  rig.exposure.rolling_s = 1e-3 * arguments.rolling_ms;
  rig.exposure.drift_stops = arguments.exposure_drift_stops;
  rig.detector = arguments.detector;
  rig.seed = arguments.seed;
  options.timing.drop_ratio = arguments.drop_ratio;
  options.timing.depth_offset_s = 1e-3 * arguments.depth_offset_ms;
  options.timing.stamp_jitter_s = 1e-3 * arguments.stamp_jitter_ms;
  options.frames = arguments.frames.value_or(capture.frames);
  options.threads = arguments.threads;
  options.version = PAS_VERSION;
  if (arguments.resume) options.existing = sim::Existing::kResume;
  if (arguments.force) options.existing = sim::Existing::kReplace;
  return options;
}

std::vector<sim::TimedPose> ReplayOf(const SimArguments& arguments,
                                     sim::SequenceOptions& options) {
  options.path = sim::ReadTrajectory(arguments.trajectory);
  options.motion = {
      {"trajectory", std::filesystem::path(arguments.trajectory).filename().string()},
      {"sha256", io::Sha256OfFile(arguments.trajectory)}};
  const double fps = options.rig.camera.fps;
  const double length_s = options.path.back().timestamp_s;
  if (!arguments.frames) options.frames = static_cast<int>(std::floor(length_s * fps)) + 1;
  return sim::Replay(options.path, options.frames, fps, arguments.trajectory);
}

sim::Recording RecordingOf(const SimArguments& arguments, const sim::Scene& scene,
                           sim::SequenceOptions& options) {
  if (arguments.trajectory.empty()) {
    return sim::PlanRecording(scene, options.rig, options.timing, options.frames);
  }
  const std::vector<sim::TimedPose> trajectory = ReplayOf(arguments, options);
  return sim::PlanRecording(trajectory, options.path, options.timing, options.rig.seed);
}

}  // namespace app
