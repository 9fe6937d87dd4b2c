#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/app.h"
#include "app/console/console.h"
#include "app/sim/detector_figures.h"
#include "app/sim/recording_options.h"
#include "app/sim/sim_arguments.h"
#include "io/image/encode_png.h"
#include "io/input_error.h"
#include "io/output_file.h"
#include "io/output_folder.h"
#include "sim/motion/clearance.h"
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
    "number of threads. A killed run says complete: false in manifest.json; --resume\n"
    "finishes it.";

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
  io::OutputFile::WriteTogether(
      {{&text, table}, {&figure, io::EncodePng(sim::DrawReport(sensor, report))}});
  if (!quiet) std::printf("%s\n%s", sensor.name.c_str(), table.c_str());
  return kDone;
}

void WarnOfContact(const sim::Scene& scene, const sim::Recording& recording) {
  std::vector<sim::TimedPose> poses;
  for (const sim::Shot& shot : recording.shots) poses.push_back({shot.time_s, shot.T_wc});
  const std::string warning = sim::ClearanceWarning(scene, poses);
  if (!warning.empty()) std::fprintf(stderr, "pas sim: warning: %s\n", warning.c_str());
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

}  // namespace

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
