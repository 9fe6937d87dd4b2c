#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "app/app.h"
#include "app/console.h"
#include "app/detector_figures.h"
#include "app/recording_options.h"
#include "sim/scene/scene_file.h"
#include "sim/sensor/read_sensor.h"
#include "sim/sensor/sensor_report.h"
#include "sim/write/atomic_file.h"
#include "sim/write/write_sequence.h"
#include "version.h"

namespace app {
namespace {

constexpr const char* kAbout =
    "Render a scene file into a sequence: RGB-D frames along a handheld trajectory, replayed\n"
    "detections and exact truth. The same scene and options give the same bytes, whatever the\n"
    "number of threads. A killed run says complete: false in manifest.json; --resume finishes "
    "it.";

struct Arguments {
  std::string scene, output, sensor_report;
  int frames = 300;
  double fps = 30.0;
  std::string sensor = "kinect1";
  sim::DetectorKind detector = sim::DetectorKind::kNoisy;
  std::uint64_t seed = 1;
  int threads = 0;
  int width = 640, height = 480;
  std::vector<double> lens;
  double shutter_ms = 0, rolling_ms = 0, exposure_drift_stops = 0;
  double drop_ratio = 0, depth_offset_ms = 0, stamp_jitter_ms = 0;
  bool resume = false, force = false, detector_report = false;
};

sim::SequenceOptions OptionsOf(const Arguments& arguments) {
  sim::SequenceOptions options;
  sim::RigOptions& rig = options.rig;
  rig.camera = sim::Resize(sim::Camera{}, arguments.width, arguments.height);
  rig.camera.fps = arguments.fps;
  if (const std::vector<double>& k = arguments.lens; !k.empty()) {
    rig.camera = sim::WithLens(rig.camera, {k[0], k[1], k[2], k[3], k[4]});
  }
  rig.sensor = sim::SensorByName(arguments.sensor);
  rig.exposure.shutter_s = 1e-3 * arguments.shutter_ms;
  rig.exposure.rolling_s = 1e-3 * arguments.rolling_ms;
  rig.exposure.drift_stops = arguments.exposure_drift_stops;
  rig.detector = arguments.detector;
  rig.seed = arguments.seed;
  options.timing.drop_ratio = arguments.drop_ratio;
  options.timing.depth_offset_s = 1e-3 * arguments.depth_offset_ms;
  options.timing.stamp_jitter_s = 1e-3 * arguments.stamp_jitter_ms;
  options.frames = arguments.frames;
  options.threads = arguments.threads;
  options.version = PAS_VERSION;
  if (arguments.resume) options.existing = sim::Existing::kResume;
  if (arguments.force) options.existing = sim::Existing::kReplace;
  return options;
}

/// Measures a sensor's model on walls: a table, and a figure of it.
int Report(const Arguments& arguments, bool quiet) {
  const sim::Sensor sensor = sim::SensorByName(arguments.sensor_report);
  const sim::SensorReport report = sim::MeasureWalls(sensor);
  const std::string table = sim::ReportTable(report);
  const std::filesystem::path folder = arguments.output;
  std::filesystem::create_directories(folder);
  std::string name = "sensor_" + sensor.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == ' '; }, '_');
  sim::WriteFileAtomically(folder / (name + ".txt"), table);
  sim::WriteFileAtomically(folder / (name + ".png"),
                           sim::EncodePng(sim::DrawReport(sensor, report)));
  if (!quiet) std::printf("%s\n%s", sensor.name.c_str(), table.c_str());
  return kDone;
}

int Run(const Arguments& arguments, bool quiet) {
  if (!arguments.sensor_report.empty()) return Report(arguments, quiet);
  if (arguments.detector_report) return ReportDetectors(arguments.output, quiet);
  if (arguments.scene.empty()) {
    throw std::invalid_argument(
        "sim: name a scene file (SCENE), or use --sensor-report SENSOR or --detector-report");
  }
  const sim::Scene scene = sim::ReadScene(arguments.scene);
  sim::SequenceOptions options = OptionsOf(arguments);
  const sim::Recording recording =
      sim::PlanRecording(scene, options.rig, options.timing, options.frames);
  int made = 0;
  {
    Progress progress("frames", recording.frames(), quiet);
    options.progress = [&](int done) { progress.Update(done); };
    made = sim::WriteSequence(scene, recording, options, arguments.output);
  }
  if (!quiet) {
    std::printf("%s: %d frames, %d rendered now%s\n", arguments.output.c_str(),
                recording.frames(), made,
                recording.lost > 0
                    ? (", " + std::to_string(recording.lost) + " lost as asked").c_str()
                    : "");
  }
  return kDone;
}

void AddCameraOptions(CLI::App& command, Arguments& a) {
  const std::string colour = "What the colour camera does", time = "Timing defects";
  command
      .add_option("--lens", a.lens,
                  "K1 K2 P1 P2 K3: distortion of the image; depth and truth follow it")
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
      .add_option("--depth-offset-ms", a.depth_offset_ms,
                  "Depth is taken this much after colour; more than 20 would make no pairs")
      ->check(CLI::Range(0.0, 20.0))
      ->group(time);
  command.add_option("--stamp-jitter-ms", a.stamp_jitter_ms, "Sd of the time stamps' error")
      ->check(CLI::Range(0.0, 1000.0))
      ->group(time);
}

/// How a scene is recorded. `prefix` goes before the names that a command may have taken.
void AddCaptureOptions(CLI::App& command, Arguments& a, const std::string& prefix) {
  command.add_option("--frames", a.frames, "Frames")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command.add_option("--fps", a.fps, "Frames a second; the motion stays the same")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  command
      .add_option("--sensor", a.sensor,
                  "ideal: exact depth, clean colour; kinect1: structured light; azure: time of "
                  "flight; d435: active stereo; FILE.yaml: one of these as `base:`, with "
                  "parameters of your own (docs/sensors.md)")
      ->capture_default_str();
  const std::map<std::string, sim::DetectorKind> detectors{
      {"perfect", sim::DetectorKind::kPerfect},
      {"noisy", sim::DetectorKind::kNoisy},
      {"poor", sim::DetectorKind::kPoor},
      {"none", sim::DetectorKind::kNone}};
  command
      .add_option("--" + prefix + "detector", a.detector,
                  "perfect: the visible box of every object; noisy: misses, jitter, wrong "
                  "classes, doubles, in runs of frames; poor: several times as many "
                  "(docs/detector.md); none: no detections.jsonl")
      ->transform(
          CLI::CheckedTransformer(detectors).description("perfect, noisy, poor or none"))
      ->default_str("noisy");
  command.add_option("--" + prefix + "seed", a.seed, "Of the trajectory and all noise")
      ->capture_default_str();
  command.add_option("--width", a.width, "Pixels; the field of view stays the same")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command.add_option("--height", a.height, "Pixels; the field of view stays the same")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  AddCameraOptions(command, a);
}

}  // namespace

std::function<sim::SequenceOptions(const sim::Scene&)> AddRecordingOptions(
    CLI::App& command, const std::string& prefix) {
  const auto arguments = std::make_shared<Arguments>();
  AddCaptureOptions(command, *arguments, prefix);
  return [arguments](const sim::Scene&) { return OptionsOf(*arguments); };
}

void AddSimCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* command = pas.add_subcommand("sim", kAbout);
  const auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
  command->add_option("SCENE", a.scene, "Scene file (YAML); see `pas scene`");
  command->add_option("--sensor-report", a.sensor_report,
                      "Instead of rendering a scene: measure this sensor on walls against its "
                      "published curve; writes a table and a figure to the output folder");
  command->add_flag("--detector-report", a.detector_report,
                    "Instead of rendering a scene: score the presets of --detector on desks of "
                    "known truth; writes detectors.txt to the output folder");
  command
      ->add_option("-o,--output", a.output, "Folder to write the sequence to; must not exist")
      ->required();
  AddCaptureOptions(*command, a, "");
  command->add_option("--threads", a.threads, "0: one a core; never changes a byte")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  CLI::Option* resume = command->add_flag(
      "--resume", a.resume, "Finish an interrupted run; same bytes as one that was not");
  command->add_flag("--force", a.force, "Replace an existing sequence")->excludes(resume);
  command->callback(
      [arguments, &globals, &exit_code] { exit_code = Run(*arguments, globals.quiet); });
}

}  // namespace app
