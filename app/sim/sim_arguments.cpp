#include "app/sim/sim_arguments.h"

#include "io/sha256.h"
#include "sim/motion/recorded.h"
#include "sim/scene/read_scene.h"
#include "sim/sensor/read_sensor.h"
#include "version.h"

namespace app {
namespace {

/// What the command line says instead of the sensor.
void SetRecordingOf(const SimArguments& arguments, sim::Sensor& sensor) {
  const auto set = [](const std::optional<double>& told, double unit, double& value) {
    if (told) value = unit * *told;
  };
  set(arguments.shutter_ms, 1e-3, sensor.exposure.shutter_s);
  set(arguments.rolling_ms, 1e-3, sensor.exposure.rolling_s);
  set(arguments.exposure_drift_stops, 1, sensor.exposure.drift_stops);
  set(arguments.drop_ratio, 1, sensor.timing.drop_ratio);
  set(arguments.repeat_ratio, 1, sensor.timing.repeat_ratio);
  set(arguments.depth_offset_ms, 1e-3, sensor.timing.depth_offset_s);
  set(arguments.stamp_jitter_ms, 1e-3, sensor.timing.stamp_jitter_s);
  set(arguments.registration_px, 1, sensor.calibration.registration_px);
  set(arguments.intrinsics_error, 1, sensor.calibration.intrinsics);
}

}  // namespace

std::vector<std::filesystem::path> InputsOf(const SimArguments& arguments) {
  return {arguments.scene, arguments.trajectory, arguments.sensor.value_or("")};
}

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
  SetRecordingOf(arguments, rig.sensor);
  // Zeros that are told are a lens too: none.
  if (!capture.distortion) rig.camera = sim::WithLens(rig.camera, rig.sensor.lens);
  rig.detector = arguments.detector;
  rig.seed = arguments.seed;
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
  if (!arguments.frames) options.frames = sim::FramesOf(options.path, fps);
  return sim::Replay(options.path, options.frames, fps, arguments.trajectory);
}

sim::Recording RecordingOf(const SimArguments& arguments, const sim::Scene& scene,
                           sim::SequenceOptions& options) {
  if (arguments.trajectory.empty()) {
    return sim::PlanRecording(scene, options.rig, options.frames);
  }
  const std::vector<sim::TimedPose> trajectory = ReplayOf(arguments, options);
  return sim::PlanRecording(trajectory, options.path, options.rig);
}

}  // namespace app
