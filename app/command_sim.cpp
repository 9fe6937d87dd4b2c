#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/app.h"
#include "app/choice_option.h"
#include "app/console.h"
#include "app/detector_figures.h"
#include "app/recording_options.h"
#include "app/sim_arguments.h"
#include "io/image/encode_png.h"
#include "io/input_error.h"
#include "io/output_file.h"
#include "io/output_folder.h"
#include "sim/motion/clearance.h"
#include "sim/scene/names.h"
#include "sim/sensor/read_sensor.h"
#include "sim/sensor/report/bend_report.h"
#include "sim/sensor/report/sensor_figure.h"
#include "sim/sensor/report/sensor_report.h"
#include "sim/write/preview.h"
#include "sim/write/write_sequence.h"

namespace app {
namespace {

constexpr const char* kAboutSim =
    "Render a scene file into a sequence: RGB-D frames along a handheld trajectory, replayed\n"
    "detections and exact truth. The same scene and options give the same bytes, whatever the\n"
    "number of threads. A killed run says complete: false in manifest.json; --resume finishes "
    "it.";

/// Measures a sensor's model on walls: a table, and a figure of it.
int Report(const SimArguments& arguments, bool quiet) {
  const sim::Sensor sensor = sim::SensorByName(arguments.sensor_report);
  const std::filesystem::path folder = arguments.output;
  io::MakeFolder(folder);
  std::string name = "sensor_" + sensor.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == ' '; }, '_');
  const io::OutputRules rules{.force = arguments.force, .inputs = {arguments.sensor_report}};
  const io::OutputFile text(folder / (name + ".txt"), rules);
  const io::OutputFile figure(folder / (name + ".png"), rules);
  const sim::SensorReport report = sim::MeasureWalls(sensor);
  const std::string table = sim::ReportTable(report) + sim::BendTable(sim::MeasureBend(sensor));
  text.Write(table);
  figure.Write(io::EncodePng(sim::DrawReport(sensor, report)));
  if (!quiet) std::printf("%s\n%s", sensor.name.c_str(), table.c_str());
  return kDone;
}

void Warn(const std::string& warning) {
  if (!warning.empty()) std::fprintf(stderr, "pas sim: warning: %s\n", warning.c_str());
}

void WarnOfContact(const sim::Scene& scene, const sim::Recording& recording) {
  std::vector<sim::TimedPose> poses;
  for (const sim::Shot& shot : recording.shots) poses.push_back({shot.time_s, shot.T_wc});
  Warn(sim::ClearanceWarning(scene, poses));
}

/// The files that a sequence is made of.
std::vector<std::filesystem::path> InputsOf(const SimArguments& arguments) {
  return {arguments.scene, arguments.trajectory, arguments.sensor.value_or("")};
}

int Preview(const SimArguments& arguments, bool quiet) {
  const io::OutputFile output(arguments.preview,
                              {.force = arguments.force, .inputs = InputsOf(arguments)});
  const sim::Scene scene = SceneOf(arguments);
  sim::SequenceOptions options = OptionsOf(arguments, scene);
  const int frame = arguments.preview_frame;
  const bool own_motion = arguments.trajectory.empty();
  if (own_motion) options.frames = frame + 1;
  sim::Recording recording = RecordingOf(arguments, scene, options);
  // Where frames are lost, a longer recording begins with those of a shorter one.
  while (own_motion && recording.frames() <= frame) {
    options.frames *= 2;
    recording = RecordingOf(arguments, scene, options);
  }
  if (!own_motion) WarnOfContact(scene, recording);
  if (frame >= recording.frames()) {
    throw io::InputError(
        "--frame " + std::to_string(frame),
        "the trajectory has frames 0 to " + std::to_string(recording.frames() - 1));
  }
  const sim::Simulator simulator(scene, options.rig);
  const sim::SimulatedFrame made = sim::Record(simulator, recording, frame);
  output.Write(io::EncodePng(sim::PreviewPicture(made)));
  if (!quiet) {
    std::printf("%s: frame %d, %.3f s: colour, depth; planes, objects\n",
                arguments.preview.c_str(), frame,
                recording.shots[static_cast<std::size_t>(frame)].time_s);
  }
  return kDone;
}

int Write(const SimArguments& arguments, bool quiet) {
  if (arguments.force) io::RefuseInputsInside(arguments.output, InputsOf(arguments));
  const sim::Scene scene = SceneOf(arguments);
  sim::SequenceOptions options = OptionsOf(arguments, scene);
  const sim::Recording recording = RecordingOf(arguments, scene, options);
  if (!recording.scenes_own) WarnOfContact(scene, recording);
  int made = 0;
  {
    Progress progress("frames", recording.frames(), quiet);
    options.progress = [&](int done) { progress.Update(done); };
    made = sim::WriteSequence(scene, recording, options, arguments.output);
  }
  if (!quiet) {
    const std::string lost =
        recording.lost > 0 ? ", " + std::to_string(recording.lost) + " lost as asked" : "";
    std::printf("%s: %d frames, %d rendered now%s\n", arguments.output.c_str(),
                recording.frames(), made, lost.c_str());
  }
  return kDone;
}

int Run(const SimArguments& arguments, bool quiet) {
  if (arguments.preview.empty() && arguments.output.empty()) {
    throw io::InputError("sim", "name a folder to write to (-o FOLDER), or --preview PNG");
  }
  if (!arguments.sensor_report.empty()) return Report(arguments, quiet);
  if (arguments.detector_report)
    return ReportDetectors(arguments.output, arguments.force, quiet);
  if (arguments.scene.empty()) {
    throw io::InputError(
        "sim", "name a scene file (SCENE), or use --sensor-report SENSOR or --detector-report");
  }
  return arguments.preview.empty() ? Write(arguments, quiet) : Preview(arguments, quiet);
}

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

/// How a scene is recorded. `prefix` goes before the names that a command may have taken.
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
      "FILE.yaml: one of these as `base:`, with "
      "parameters of your own (docs/sensors.md); left out: as the scene says, else kinect1");
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

}  // namespace

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

void AddSimCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* command = pas.add_subcommand("sim", kAboutSim);
  const auto arguments = std::make_shared<SimArguments>();
  SimArguments& a = *arguments;
  command->add_option("SCENE", a.scene, "Scene file (YAML); see `pas scene`");
  CLI::Option* sensor_report = command->add_option(
      "--sensor-report", a.sensor_report,
      "Instead of rendering a scene: measure this sensor on walls against its "
      "published curve; writes a table and a figure to the output folder");
  CLI::Option* detector_report = command->add_flag(
      "--detector-report", a.detector_report,
      "Instead of rendering a scene: score the presets of --detector on desks of "
      "known truth; writes detectors.txt to the output folder");
  CLI::Option* output = command->add_option(
      "-o,--output", a.output, "Folder to write the sequence to; must not exist, or be empty");
  CLI::Option* preview = command->add_option(
      "--preview", a.preview,
      "Instead of a sequence: one picture (PNG) of one frame: colour, depth, plane ids, "
      "object ids");
  preview->excludes(output)->excludes(sensor_report)->excludes(detector_report);
  command->add_option("--frame", a.preview_frame, "Which frame --preview shows")
      ->check(CLI::Range(0, 999999))
      ->needs(preview)
      ->capture_default_str();
  command->add_option("--threads", a.threads, "0: one a core; never changes a byte")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  CLI::Option* resume = command->add_flag(
      "--resume", a.resume, "Finish an interrupted run; same bytes as one that was not");
  command->add_flag("--force", a.force, "Replace an existing sequence, picture or report")
      ->excludes(resume);
  AddCaptureOptions(*command, a, "");
  command->callback(
      [arguments, &globals, &exit_code] { exit_code = Run(*arguments, globals.quiet); });
}

}  // namespace app
