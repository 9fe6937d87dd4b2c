#include <fmt/core.h>

#include <cstdio>
#include <optional>

#include "app/app.h"
#include "app/calibrate/warp_picture.h"
#include "app/console/console.h"
#include "app/console/stop_signal.h"
#include "app/options/depth_sensor_option.h"
#include "io/image/encode_png.h"
#include "io/output_file.h"
#include "slam/calibrate/warp_file.h"
#include "slam/run/calibrate_sequence.h"
#include "slam/run/config_file.h"

namespace app {
namespace {

struct CalibrateArguments {
  slam::CalibrateOptions options;
  std::string sensor = kAutoSensor;
  std::string config_file, output, picture;
  bool force = false;
};

int RunCalibrate(CalibrateArguments& arguments, bool quiet) {
  slam::CalibrateOptions& options = arguments.options;
  const io::OutputRules rules{
      .force = arguments.force,
      .inputs = {options.sequence, options.camera, arguments.config_file}};
  io::RefuseSameFile({arguments.output, arguments.picture});
  const io::OutputFile output(arguments.output, rules);
  std::optional<io::OutputFile> picture;
  if (!arguments.picture.empty()) picture.emplace(arguments.picture, rules);
  options.config = ConfigForRecording(arguments.sensor, arguments.config_file, options.sequence,
                                      options.camera, quiet);
  const StopSignal stop;
  options.stop = [] { return StopSignal::Caught() != 0; };
  PassProgress progress(quiet);
  options.progress = [&](const char* pass, int done, int total) {
    progress.Update(pass, done, total);
  };
  const slam::Calibration calibration = slam::CalibrateSequence(options);
  progress.End();
  if (calibration.stopped) {
    PrintAside("pas: interrupted; nothing is written\n");
    return ExitCodeOf(StopSignal::Caught());
  }
  for (const std::string& warning : calibration.warnings) PrintWarning(warning);
  if (calibration.tracked == 0) {
    PrintAside("pas: no warp is written, because no frame was tracked\n");
    return kFailure;
  }
  const slam::WarpEvidence& evidence = calibration.evidence;
  if (!evidence.worth_it) {
    PrintAside(fmt::format("pas: no warp is written, because {}\n", evidence.Doubt()));
    return kFailure;
  }
  const std::string summary = fmt::format(
      "{:.2f} mm/m rms, from {} frames; what was learnt took out {:.0f} % of the variance of "
      "what came later (Student's t {:.1f} of {} epochs)",
      1e3 * calibration.warp.Rms(), calibration.tracked, 100 * evidence.gain,
      evidence.student_t, evidence.epochs);
  std::vector<io::OutputFile::Content> contents{
      {&output, slam::WarpText(calibration.warp, summary)}};
  if (picture) contents.push_back({&*picture, io::EncodePng(DrawWarp(calibration.warp))});
  io::OutputFile::WriteTogether(contents);
  if (!quiet) fmt::print("{}: {}\n", arguments.output, summary);
  return kDone;
}

}  // namespace

void AddCalibrateCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* command = pas.add_subcommand(
      "calibrate",
      "Learns from the planes of a recording how its depth camera bends what is flat, for\n"
      "`pas slam --depth-warp FILE` (docs/calibration.md). Writes nothing, with exit code 1,\n"
      "when the recording does not show that it does.");
  auto arguments = std::make_shared<CalibrateArguments>();
  slam::CalibrateOptions& options = arguments->options;
  command
      ->add_option("SEQ", options.sequence,
                   "Sequence folder, a TUM RGB-D folder, or RECORDING.bag of ROS 1")
      ->required()
      ->type_name("DIR|BAG");
  command->add_option("-o,--output", arguments->output, "File to write (YAML)")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--picture", arguments->picture,
                   "Also draw the pattern and its standard deviation (PNG)")
      ->type_name("FILE");
  command->add_option("--camera", options.camera,
                      "As of pas slam: tum1 | tum2 | tum3 | a file; default: SEQ/camera.yaml");
  AddSensorOption(*command, arguments->sensor);
  command->add_option("--config", arguments->config_file,
                      "Settings over the defaults, YAML; `pas config` prints them all");
  command->add_option("--frames", options.frames, "Only the first so many; 0 = all")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  command->add_flag("--force", arguments->force, "Replace files that exist");
  command->callback([arguments, &globals, &exit_code] {
    exit_code = RunCalibrate(*arguments, globals.quiet);
  });
}

}  // namespace app
