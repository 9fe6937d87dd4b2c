#include "app/sim/recording_options.h"

#include <memory>
#include <utility>

#include "app/options/choice_option.h"
#include "sim/scene/names.h"

namespace app {
namespace {

void AddMotionOptions(CLI::App& command, SimArguments& a) {
  const std::string motion = "How the camera moves (default: as the scene says)";
  command.add_option("--motion", a.motion, "Preset, instead of the scene's; docs/scenes.md")
      ->check(Choice(sim::kPresetNames))
      ->group(motion);
  command.add_option("--speed", a.speed_m_s, "Mean, m/s at 30 Hz")
      ->check(CLI::Range(0.005, 3.0))
      ->group(motion);
  command.add_option("--turn", a.turn_deg_s, "Mean, deg/s at 30 Hz")
      ->check(CLI::Range(0.5, 180.0))
      ->group(motion);
  command
      .add_option("--trajectory", a.trajectory,
                  "Replay this file, lines of 'timestamp tx ty tz qx qy qz qw' (TUM; camera to "
                  "world); all of it unless --frames says less")
      ->excludes("--motion")
      ->excludes("--speed")
      ->excludes("--turn")
      ->group(motion);
}

void AddCameraOptions(CLI::App& command, SimArguments& a) {
  const std::string colour = "What the colour camera does (left out: as the sensor has it)",
                    time = "Timing defects (left out: as the sensor has them)",
                    calibration = "What calibration leaves (left out: as the sensor has it)";
  command
      .add_option("--lens", a.lens,
                  "K1 K2 P1 P2 K3: distortion of the image, depth and truth follow it; left "
                  "out: as the scene says, else as the sensor has it")
      ->expected(5)
      ->group(colour);
  command.add_option("--shutter-ms", a.shutter_ms, "Exposure time: motion blur")
      ->check(CLI::Range(0.0, 1000.0))
      ->group(colour);
  command
      .add_option("--rolling-ms", a.rolling_ms, "From the first row's exposure to the last's")
      ->check(CLI::Range(0.0, 1000.0))
      ->group(colour);
  command
      .add_option("--exposure-drift", a.exposure_drift_stops,
                  "Auto-exposure wanders within this many stops either way")
      ->check(CLI::Range(0.0, 4.0))
      ->group(colour);
  command.add_option("--drop-ratio", a.drop_ratio, "Share of frames lost")
      ->check(CLI::Range(0.0, 0.9))
      ->group(time);
  command
      .add_option("--repeat-ratio", a.repeat_ratio,
                  "Share of frames that show the one before again")
      ->check(CLI::Range(0.0, 0.9))
      ->group(time);
  command
      .add_option("--depth-offset-ms", a.depth_offset_ms,
                  "Depth is taken this much after colour; more than 20 would make no pairs")
      ->check(CLI::Range(0.0, 20.0))
      ->group(time);
  command.add_option("--stamp-jitter-ms", a.stamp_jitter_ms, "Sd of the time stamps' error")
      ->check(CLI::Range(0.0, 1000.0))
      ->group(time);
  command
      .add_option("--registration-px", a.registration_px,
                  "How far depth lies beside its colour, rms over devices")
      ->check(CLI::Range(0.0, 20.0))
      ->group(calibration);
  command
      .add_option(
          "--intrinsics-error", a.intrinsics_error,
          "Sd of what camera.yaml tells of focal length and principal point, as a share "
          "of the focal length; gt/camera.yaml tells them as they are")
      ->check(CLI::Range(0.0, 0.05))
      ->group(calibration);
}

}  // namespace

void AddCaptureOptions(CLI::App& command, SimArguments& a, const std::string& prefix) {
  command.add_option("--frames", a.frames, "Frames; left out: as the scene says, else 300")
      ->check(CLI::Range(1, 1000000));
  command
      .add_option("--fps", a.fps,
                  "Frames a second, the motion stays the same; left out: as the scene says, "
                  "else 30")
      ->check(CLI::Range(0.1, 1000.0));
  command.add_option(
      "--" + prefix + "sensor", a.sensor,
      "ideal: exact depth, clean colour; kinect1: structured light, as recordings of the first "
      "Kinect are; kinect1-clean: its noise alone; azure: time of flight; d435: active stereo; "
      "FILE.yaml: one of these as `base:`, with parameters of your own (docs/sensors.md); left "
      "out: as the scene says, else kinect1");
  const std::vector<std::pair<std::string, sim::DetectorKind>> detectors{
      {"perfect", sim::DetectorKind::kPerfect},
      {"noisy", sim::DetectorKind::kNoisy},
      {"poor", sim::DetectorKind::kPoor},
      {"none", sim::DetectorKind::kNone}};
  command
      .add_option("--" + prefix + "detector", a.detector,
                  "perfect: the visible box of every object; noisy: misses, jitter, wrong "
                  "classes, doubles, in runs of frames; poor: several times as many "
                  "(docs/detector.md); none: no detections.jsonl")
      ->transform(ChoiceOf(detectors))
      ->default_str("noisy");
  command
      .add_option("--" + prefix + "seed", a.seed,
                  prefix.empty() ? "Of the trajectory and all noise"
                                 : "Of the trajectory and all noise; left out: --seed if that "
                                   "is given, else 1")
      ->capture_default_str();
  for (const auto& [name, into] : {std::pair("--width", &a.width), {"--height", &a.height}}) {
    command
        .add_option(name, *into,
                    "Pixels, the field of view stays the same; left out: as the scene says, "
                    "else 640 x 480")
        ->check(CLI::Range(16, 8192));
  }
  AddMotionOptions(command, a);
  AddCameraOptions(command, a);
}

ReadRecording AddRecordingOptions(CLI::App& command, const std::string& prefix) {
  const auto arguments = std::make_shared<SimArguments>();
  AddCaptureOptions(command, *arguments, prefix);
  const CLI::Option* seed_option = command.get_option("--" + prefix + "seed");
  return [arguments, seed_option](const std::string& scene_file,
                                  std::optional<std::uint64_t> seed) {
    arguments->scene = scene_file;
    if (seed && seed_option->count() == 0) arguments->seed = *seed;
    SceneRecording result;
    result.inputs = InputsOf(*arguments);
    result.scene = SceneOf(*arguments);
    result.options = OptionsOf(*arguments, result.scene);
    result.recording = RecordingOf(*arguments, result.scene, result.options);
    return result;
  };
}

}  // namespace app
