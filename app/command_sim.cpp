#include <cstdio>
#include <map>

#include "app/app.h"
#include "app/console.h"
#include "sim/scene/scene_file.h"
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
  std::string scene, output;
  int frames = 300;
  double fps = 30.0;
  sim::SensorKind sensor = sim::SensorKind::kKinect1;
  sim::DetectorKind detector = sim::DetectorKind::kNoisy;
  std::uint64_t seed = 1;
  int threads = 0;
  int width = 640, height = 480;
  bool resume = false, force = false;
};

int Run(const Arguments& arguments, bool quiet) {
  const sim::Scene scene = sim::ReadScene(arguments.scene);
  sim::SequenceOptions options;
  options.rig.camera = sim::Resize(sim::Camera{}, arguments.width, arguments.height);
  options.rig.camera.fps = arguments.fps;
  options.rig.sensor = arguments.sensor;
  options.rig.detector = arguments.detector;
  options.rig.seed = arguments.seed;
  options.frames = arguments.frames;
  options.threads = arguments.threads;
  options.version = PAS_VERSION;
  if (arguments.resume) options.existing = sim::Existing::kResume;
  if (arguments.force) options.existing = sim::Existing::kReplace;

  int made = 0;
  {
    Progress progress("frames", arguments.frames, quiet);
    options.progress = [&](int done) { progress.Update(done); };
    made = sim::WriteSequence(scene, options, arguments.output);
  }
  if (!quiet) {
    std::printf("%s: %d frames, %d rendered now\n", arguments.output.c_str(), arguments.frames,
                made);
  }
  return kDone;
}

}  // namespace

void AddSimCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* command = pas.add_subcommand("sim", kAbout);
  const auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
  command->add_option("SCENE", a.scene, "Scene file (YAML); see `pas scene`")->required();
  command
      ->add_option("-o,--output", a.output, "Folder to write the sequence to; must not exist")
      ->required();
  command->add_option("--frames", a.frames, "Frames")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--fps", a.fps, "Frames a second; the motion stays the same")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  const std::map<std::string, sim::SensorKind> sensors{{"ideal", sim::SensorKind::kIdeal},
                                                       {"kinect1", sim::SensorKind::kKinect1}};
  command
      ->add_option(
          "--sensor", a.sensor,
          "ideal: exact depth (1/5000 m steps), clean colour; kinect1: structured-light "
          "noise, shadows and range, noisy colour")
      ->transform(CLI::CheckedTransformer(sensors))
      ->default_str("kinect1");
  const std::map<std::string, sim::DetectorKind> detectors{
      {"perfect", sim::DetectorKind::kPerfect},
      {"noisy", sim::DetectorKind::kNoisy},
      {"none", sim::DetectorKind::kNone}};
  command
      ->add_option("--detector", a.detector,
                   "perfect: the visible box of every object; noisy: misses, jitter, wrong "
                   "classes, doubles; none: no detections.jsonl")
      ->transform(CLI::CheckedTransformer(detectors))
      ->default_str("noisy");
  command->add_option("--seed", a.seed, "Of the trajectory and all noise")
      ->capture_default_str();
  command->add_option("--threads", a.threads, "0: one a core; never changes a byte")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->add_option("--width", a.width, "Pixels; the field of view stays the same")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command->add_option("--height", a.height, "Pixels; the field of view stays the same")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  CLI::Option* resume = command->add_flag(
      "--resume", a.resume, "Finish an interrupted run; same bytes as one that was not");
  command->add_flag("--force", a.force, "Replace an existing sequence")->excludes(resume);
  command->callback(
      [arguments, &globals, &exit_code] { exit_code = Run(*arguments, globals.quiet); });
}

}  // namespace app
