#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/app.h"
#include "app/console/console.h"
#include "app/console/stop_signal.h"
#include "app/live/live_scene.h"
#include "app/options/choice_option.h"
#include "app/options/depth_sensor_option.h"
#include "app/options/segmentation_option.h"
#include "app/sim/recording_options.h"
#include "io/input_error.h"
#include "io/output_file.h"
#include "slam/run/config_file.h"
#include "slam/run/run_sequence.h"
#include "slam/run/run_writer.h"
#include "version.h"

namespace app {
namespace {

struct SlamArguments {
  slam::RunOptions options;
  std::string variant = "full";
  std::string sensor = kAutoSensor;
  std::string config_file;
  std::optional<slam::Segmentation> segmentation;
  std::optional<slam::AssociationRule> association;
  std::optional<slam::StructureMode> structure;
  bool print_config = false;
  bool loop_closing = false;
  std::string mapping, depth_warp;
  std::optional<int> detect_every;
  std::string live_scene;
  ReadRecording recording;  ///< with live_scene
  bool no_truth = false;
  bool seeded = false;  ///< --seed was given
};

/// Frames ahead of the estimator: enough to keep a second core busy, few enough for memory.
constexpr int kFramesAhead = 2;

/// One --seed seeds both, as `pas sim --seed N` and `pas slam --seed N` would.
SceneRecording ReadScene(const SlamArguments& arguments) {
  return arguments.recording(arguments.live_scene, arguments.seeded
                                                       ? std::optional(arguments.options.seed)
                                                       : std::nullopt);
}

/// What measures the depth of a scene, as the estimator names it.
std::string SensorOf(const SceneRecording& recorded) {
  const sim::DepthModel& depth = recorded.options.rig.sensor.depth;
  if (std::holds_alternative<sim::AzureModel>(depth)) return "azure";
  if (std::holds_alternative<sim::D435Model>(depth)) return "d435";
  return slam::DepthSensorNames().front();
}

slam::RunOutcome RunOnScene(const SlamArguments& arguments, slam::RunOptions options,
                            SceneRecording recorded) {
  LiveScene live(recorded.scene, recorded.options.rig, std::move(recorded.recording),
                 options.threads == 1 ? 0 : kFramesAhead);
  options.sequence = arguments.live_scene;
  if (!arguments.no_truth) options.sequence = options.run / "truth";
  slam::LiveTruth* truth =
      arguments.no_truth ? nullptr : &live.KeepTruth(recorded.scene, recorded.options);
  return slam::RunLive({live, live.camera(), live.MakeDetector(options.config.classes), truth},
                       options);
}

/// Options that render a scene instead of reading a folder.
void AddLiveOptions(CLI::App& command, SlamArguments& arguments,
                    const std::vector<CLI::Option*>& of_folders) {
  CLI::Option* live = command.add_option(
      "--live", arguments.live_scene,
      "SCENE.yaml: render its frames in memory instead of reading SEQ; the estimator gets "
      "what `pas sim` would write, and the run is that of these files without a first look "
      "(first_look: frames: 0 of a --config). The truth is written to RUN/truth, so that `pas "
      "eval RUN` scores it");
  for (CLI::Option* option : of_folders) live->excludes(option);
  const std::vector<CLI::Option*> before = command.get_options();
  command.add_flag("--no-truth", arguments.no_truth,
                   "Do not write RUN/truth: nothing of the scene reaches the disk");
  arguments.recording = AddRecordingOptions(command, "sim-");
  for (CLI::Option* option : command.get_options()) {
    if (std::find(before.begin(), before.end(), option) != before.end()) continue;
    option->needs(live)->group("With --live, as in `pas sim`");
  }
}

/// Settings with an option of their own, which goes over a --config.
void AddSettingOptions(CLI::App& command, SlamArguments& arguments) {
  command
      .add_option("--mapping", arguments.mapping,
                  "sync: between frames; the same input gives the same bytes. async: on a "
                  "thread of its own; tracking never waits for an adjustment. Default: as "
                  "--config says, else sync")
      ->check(Choice({"sync", "async"}));
  command.add_option(
      "--depth-warp", arguments.depth_warp,
      "auto: learn from the planes of the run how the depth camera bends what is flat, and "
      "take that out once it is worth it; off; or a file of pas calibrate. Default: as "
      "--config says, else auto");
  command
      .add_option("--association", arguments.association,
                  "How planes are associated by --variant full. integrated | parameters | "
                  "manhattan-slam | planar-slam | sp-slam (as those programs decide, all else "
                  "being this one's). Default: as --config says, else integrated")
      ->transform(ChoiceByIndex<slam::AssociationRule>(slam::AssociationRuleNames()));
  command
      .add_option(
          "--structure", arguments.structure,
          "What is assumed of how planes stand to each other. none | parallel (parallel "
          "and perpendicular planes) | manhattan (one Manhattan frame) | mixture (many) "
          "| supposed (planes supposed at straight edges). Default: as --config says, "
          "else parallel")
      ->transform(ChoiceByIndex<slam::StructureMode>(slam::StructureModeNames()));
  command.add_flag("--loop-closing", arguments.loop_closing,
                   "Recognise known places and draw the map together there");
}

/// Says on stderr how a run ended that did not go well. @returns the exit code
int Verdict(const slam::RunOutcome& outcome, const std::string& sequence) {
  if (outcome.stopped) {
    PrintAside(
        fmt::format("pas: interrupted after {} of {} frames; the run up to there is written\n",
                    outcome.frames, outcome.sequence_frames));
    return ExitCodeOf(StopSignal::Caught());
  }
  if (outcome.tracked == 0) {
    PrintAside(fmt::format(
        "pas: tracking never started: no frame of {} has enough features with depth, "
        "nor planes or edges that could hold the camera\n",
        sequence));
    return kFailure;
  }
  if (outcome.ended_lost && 2 * outcome.tracked < outcome.frames) {
    PrintAside(fmt::format("pas: the camera was lost for more than half of {}\n", sequence));
    return kFailure;
  }
  return kDone;
}

void RequireFullForAssociation(const SlamArguments& arguments) {
  if (!arguments.association || arguments.variant == "full") return;
  throw io::InputError("--association", "is of --variant full, found " + arguments.variant +
                                            "; leave one of the two out");
}

/// Takes into the settings what the options say over them.
void SetOptions(const SlamArguments& arguments, slam::Config& config) {
  if (arguments.segmentation) config.plane_extraction.segmentation = *arguments.segmentation;
  if (arguments.association) config.association.rule = *arguments.association;
  if (arguments.structure) config.structure.mode = *arguments.structure;
  if (arguments.loop_closing) config.loop_closing.enabled = true;
  if (arguments.detect_every) config.detection.every = *arguments.detect_every;
  if (!arguments.depth_warp.empty()) config.depth_warp.source = arguments.depth_warp;
  if (!arguments.mapping.empty()) config.async_mapping = arguments.mapping == "async";
}

/// What a run reads: --force replaces no folder that holds any of it.
std::vector<std::filesystem::path> InputsOf(const SlamArguments& arguments,
                                            const slam::Config& config,
                                            const std::optional<SceneRecording>& scene) {
  std::vector<std::filesystem::path> inputs =
      scene ? scene->inputs : std::vector<std::filesystem::path>{};
  inputs.insert(inputs.end(),
                {arguments.config_file, arguments.options.camera, config.depth_warp.source,
                 slam::ModelFile(arguments.options.detector)});
  // Words, such as tum1 and auto, are no files, and a run may be called so.
  std::error_code ignored;
  std::erase_if(inputs, [&](const auto& file) {
    return !std::filesystem::is_regular_file(file, ignored);
  });
  inputs.push_back(arguments.options.sequence);
  return inputs;
}

int RunSlam(SlamArguments& arguments, bool quiet) {
  RequireFullForAssociation(arguments);
  if (arguments.print_config) {
    slam::Config config = ConfigFrom(arguments.sensor, arguments.config_file);
    SetOptions(arguments, config);
    fmt::print("{}", slam::ConfigAsYaml(config));
    return kDone;
  }
  slam::RunOptions& options = arguments.options;
  const bool live = !arguments.live_scene.empty();
  if ((options.sequence.empty() && !live) || options.run.empty()) {
    throw io::InputError("pas slam",
                         "needs a sequence folder or a bag, or --live SCENE.yaml, and -o RUN; "
                         "see pas slam --help");
  }
  options.variant = slam::VariantOf(arguments.variant);
  // What needs no look at the recording to be refused.
  if (!options.detector.empty()) slam::RequireDetectorChoice(options.detector);
  slam::RunWriter::RequirePlace(options.run, options.force);
  std::optional<SceneRecording> scene;
  if (live) scene = ReadScene(arguments);
  options.config =
      live ? ConfigFrom(arguments.sensor == kAutoSensor ? SensorOf(*scene) : arguments.sensor,
                        arguments.config_file)
           : ConfigForRecording(arguments.sensor, arguments.config_file, options.sequence,
                                options.camera, quiet);
  SetOptions(arguments, options.config);
  if (options.force) {
    io::RefuseInputsInside(options.run, InputsOf(arguments, options.config, scene));
  }
  options.version = PAS_VERSION;
  const StopSignal stop;
  options.stop = [] { return StopSignal::Caught() != 0; };
  PassProgress progress(quiet);
  options.progress = [&](const char* pass, int done, int total) {
    progress.Update(pass, done, total);
  };
  options.warn = [quiet](const std::string& warning) {
    PrintAside(fmt::format("{}pas: warning, while it runs: {}\n", quiet ? "" : "\n", warning));
  };

  const slam::RunOutcome outcome =
      live ? RunOnScene(arguments, options, std::move(*scene)) : slam::RunSequence(options);
  progress.End();
  for (const std::string& warning : outcome.warnings) PrintWarning(warning);
  if (!quiet) {
    fmt::print("{}: {} of {} frames tracked, {} keyframes, {} map planes{}, {:.1f} frames/s\n",
               options.run.string(), outcome.tracked, outcome.frames, outcome.keyframes,
               outcome.map_planes,
               outcome.loops > 0 ? fmt::format(", {} loop{} closed", outcome.loops,
                                               outcome.loops > 1 ? "s" : "")
                                 : "",
               outcome.frames / outcome.wall_time_s);
  }
  return Verdict(outcome, live ? arguments.live_scene : options.sequence.string());
}

}  // namespace

void AddSlamCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* command =
      pas.add_subcommand("slam", "Track the camera and map the planes of a sequence");
  auto arguments = std::make_shared<SlamArguments>();
  slam::RunOptions& options = arguments->options;
  CLI::Option* sequence =
      command->add_option("SEQ", options.sequence,
                          "Sequence folder, a TUM RGB-D folder, or RECORDING.bag of ROS 1");
  command->add_option("-o,--output", options.run, "Run folder to write");
  command
      ->add_option("--variant", arguments->variant,
                   "full | no-association (planes by parameters alone) | "
                   "no-processing-no-association | points (no planes)")
      ->capture_default_str();
  CLI::Option* detector = command->add_option(
      "--detector", options.detector,
      "replay (SEQ/detections.jsonl) | yolox:FILE.onnx (a YOLOX network, settings in "
      "--config, yolox:) | none; default: replay if the file is there");
  command
      ->add_option("--detect-every", arguments->detect_every,
                   "Ask the detector in every Nth frame and carry its boxes over the others. "
                   "Default: as --config says, else 1")
      ->check(CLI::Range(1, 1000));
  CLI::Option* camera =
      command->add_option("--camera", options.camera,
                          "tum1 | tum2 | tum3 | a camera.yaml, or settings of ORB-SLAM2, "
                          "ORB-SLAM3, OpenCV or ROS; default: SEQ/camera.yaml, or "
                          "the CameraInfo of a bag");
  AddSensorOption(*command, arguments->sensor);
  AddSegmentationOption(*command, arguments->segmentation);
  command->add_option("--config", arguments->config_file,
                      "Settings over the defaults, YAML; `pas config` prints them all");
  command->add_flag("--print-config", arguments->print_config,
                    "Print the settings, as `pas config` does, and stop");
  CLI::Option* seed =
      command
          ->add_option("--seed", options.seed,
                       "Seed of RANSAC for the edge lines of planes; with --live of the "
                       "simulator too, unless --sim-seed says another")
          ->capture_default_str();
  command
      ->add_option("--threads", options.threads,
                   "Threads; 0 = one a core. Changes the speed, never a result")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  AddSettingOptions(*command, *arguments);
  command->add_flag("--save-segmentation", options.save_segmentation,
                    "Also write the label image of every frame");
  command->add_flag("--force", options.force, "Replace an existing run folder");
  AddLiveOptions(*command, *arguments, {sequence, detector, camera});
  command->callback([arguments, seed, &globals, &exit_code] {
    arguments->seeded = seed->count() > 0;
    exit_code = RunSlam(*arguments, globals.quiet);
  });
}

}  // namespace app
