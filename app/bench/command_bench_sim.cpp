#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "app/app.h"
#include "app/bench/bench_sequences.h"
#include "io/image/encode_png.h"
#include "sim/families/families.h"
#include "sim/scene/read_scene.h"
#include "sim/trace/frame_renderer.h"
#include "sim/truth/truth_json.h"
#include "sim/write/carried_exposure.h"
#include "sim/write/parallel_frames.h"
#include "sim/write/timing.h"
#include "sim/write/write_sequence.h"

namespace app {
namespace {

constexpr const char* kAboutBenchSim =
    "Frames a second of the simulator: colour, depth, ids and noise of the first Kinect at\n"
    "640 x 480 with one sun, in memory and with files; milliseconds a stage; the ratio to the\n"
    "ray tracer alone on the same rays; cost against the number of objects; peak memory.";

struct SimBenchArguments {
  std::string scene;
  int frames = 60;
  int most_boxes = 10000;
  bool files = true;
};

double WallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double ProcessorSeconds(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double PeakMebibytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Seconds of this thread that the work takes.
template <typename Work>
double Cost(const Work& work) {
  const double start = ProcessorSeconds(CLOCK_THREAD_CPUTIME_ID);
  work();
  return ProcessorSeconds(CLOCK_THREAD_CPUTIME_ID) - start;
}

struct Rate {
  double fps = 0;      ///< by the clock on the wall
  double core_ms = 0;  ///< processor time a frame
};

/// What `count` frames cost that make(frame) makes.
template <typename Make>
Rate RateOf(int count, const Make& make) {
  const double wall = WallSeconds(), cores = ProcessorSeconds(CLOCK_PROCESS_CPUTIME_ID);
  make();
  return {count / (WallSeconds() - wall),
          1e3 * (ProcessorSeconds(CLOCK_PROCESS_CPUTIME_ID) - cores) / count};
}

/// The last figure is what two cores give that nothing else uses.
void Print(const char* what, const Rate& rate) {
  std::printf("%-28s %7.1f frames/s %8.1f ms of a core: %5.1f frames/s of two idle ones\n",
              what, rate.fps, rate.core_ms, 2e3 / rate.core_ms);
}

Rate InMemory(const sim::Simulator& simulator, const std::vector<sim::TimedPose>& path,
              int threads) {
  std::vector<int> frames;
  frames.reserve(path.size());
  for (int i = 0; i < static_cast<int>(path.size()); ++i) frames.push_back(i);
  return RateOf(static_cast<int>(path.size()), [&] {
    sim::ForEachFrame(
        frames, threads,
        [&](int i) { simulator.Simulate(i, path[static_cast<std::size_t>(i)].T_wc); }, {});
  });
}

Rate WithFiles(const sim::Scene& scene, const std::vector<sim::TimedPose>& path, int threads) {
  const ScratchFolder scratch("sim");
  sim::SequenceOptions options;
  options.threads = threads;
  options.existing = sim::Existing::kReplace;
  return RateOf(static_cast<int>(path.size()),
                [&] { sim::WriteSequence(scene, path, options, scratch.path()); });
}

/// Processor seconds a frame, on one thread.
struct Stages {
  double trace = 0, colour = 0, depth_noise = 0, colour_noise = 0, truth = 0, png = 0, bare = 0;
};

Stages MeasureStages(const sim::Scene& scene, const std::vector<sim::TimedPose>& path) {
  const sim::FrameRenderer renderer(scene, sim::Camera{});
  const sim::TruthMaker truth(renderer);
  const sim::Sensor sensor;
  sim::RenderOptions all{.projector_offset_m = sim::SecondEyeOffset(sensor.depth)};
  sim::RenderOptions grey = all;
  grey.colour = false;
  for (const sim::TimedPose& at : path) renderer.Render(at.T_wc, all);  // bakes the prints
  Stages sum;
  sim::Rendering seen;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const sim::Pose& T_wc = path[i].T_wc;
    const double trace = Cost([&] { renderer.Render(T_wc, grey, seen); });
    sum.trace += trace;
    sum.colour += Cost([&] { renderer.Render(T_wc, all, seen); }) - trace;
    cv::Mat depth, colour;
    sum.depth_noise += Cost([&] {
      depth = sim::EncodeDepth(sim::MeasureDepth(seen, sensor.depth, renderer.camera(), 1, i),
                               renderer.camera().depth_factor);
    });
    sum.colour_noise += Cost([&] {
      colour = sim::MeasureColour(seen.radiance, sensor.colour, sim::PixelNoise(1, i));
    });
    sum.truth += Cost([&] { sim::FrameTruthJson(0, truth.Describe(seen, T_wc)); });
    sum.png += Cost([&] {
      for (const cv::Mat& image :
           {colour, depth, cv::Mat(seen.plane_id), cv::Mat(seen.object_id)})
        io::EncodePng(image);
    });
    sum.bare += renderer.BareTraversal_s(T_wc, all);
  }
  return sum;
}

/// Milliseconds of this thread a frame for colour by rolling shutter with motion blur, from one
/// rendering, of a hand that moves fast.
double ExposureCost_ms(sim::Scene scene, int frames) {
  constexpr double kFps = 30.0;
  constexpr int kPosesAFrame = 8;
  constexpr sim::Exposure kExposure{.shutter_s = 0.015, .rolling_s = 0.03};
  scene.motion.preset = "fast";
  scene.motion.speed_m_s = scene.motion.turn_deg_s = 0;
  const auto path =
      sim::MakeTrajectory(scene, frames * kPosesAFrame + 1, kFps * kPosesAFrame, 1);
  const sim::FrameRenderer renderer(scene, sim::Camera{});
  sim::Rendering seen;
  double seconds = 0;
  for (int i = 0; i < frames; ++i) {
    const auto around = [&](double later_s) { return sim::PoseAt(path, i / kFps + later_s); };
    renderer.Render(around(0), {}, seen);
    seconds += Cost([&] { sim::CarryExposure(renderer, kExposure, around, around(0), seen); });
  }
  return 1e3 * seconds / frames;
}

void PrintStages(const Stages& sum, std::size_t frames) {
  const double ms = 1e3 / static_cast<double>(frames);
  std::printf("\nms of a core a frame, one thread\n");
  const auto line = [&](const char* what, double s) {
    std::printf("  %-26s %8.2f\n", what, s * ms);
  };
  line("trace, ids, exact depth", sum.trace);
  line("sun, prints, smooth edges", sum.colour);
  line("depth noise", sum.depth_noise);
  line("colour noise", sum.colour_noise);
  line("truth", sum.truth);
  line("PNG", sum.png);
  const double render = sum.trace + sum.colour;
  const double frame = render + sum.depth_noise + sum.colour_noise + sum.truth;
  line("the ray tracer alone", sum.bare);
  std::printf("  rendering / ray tracer alone, same rays   %6.2f\n", render / sum.bare);
  std::printf("  whole frame / ray tracer alone            %6.2f\n", frame / sum.bare);
}

/// A square field of boxes on a floor, all in view, of the same share of the ground whatever
/// their number.
sim::Scene Field(int boxes) {
  sim::Scene scene;
  scene.name = "field";
  const auto add = [&](sim::Role role, const Eigen::Vector3d& center,
                       const Eigen::Vector3d& size) {
    sim::Object object;
    object.id = static_cast<int>(scene.objects.size()) + 1;
    object.name = "box_" + std::to_string(object.id);
    object.class_name = "book";
    object.role = role;
    object.center_w = center;
    object.size = size;
    scene.objects.push_back(object);
  };
  add(sim::Role::kStructure, {0, 0, -0.05}, {4, 4, 0.1});
  const int side = static_cast<int>(std::ceil(std::sqrt(boxes)));
  const double cell = 1.2 / side;
  for (int i = 0; i < boxes; ++i) {
    const int column = i % side, row = i / side;
    const double x = (column + 0.5) * cell - 0.6, y = (row + 0.5) * cell - 0.6;
    add(sim::Role::kRegular, {x, y, 0.2 * cell}, {0.6 * cell, 0.6 * cell, 0.4 * cell});
  }
  return scene;
}

/// From beside the field and 1.4 m above it, down at its middle.
sim::Pose AboveField() {
  const Eigen::Vector3d from(0, -1.0, 1.4);
  sim::Pose T_wc;
  const Eigen::Vector3d z = -from.normalized(), x = Eigen::Vector3d::UnitX();
  T_wc.R << x, z.cross(x), z;
  T_wc.t = from;
  return T_wc;
}

void PrintScaling(int most) {
  std::printf("\nboxes in view     ms of a core a frame   MiB in all\n");
  for (int boxes = 10; boxes <= most; boxes *= 10) {
    const sim::Simulator simulator(Field(boxes), sim::RigOptions{});
    simulator.Simulate(0, AboveField());
    constexpr int kFrames = 3;
    const double seconds = Cost([&] {
      for (int i = 0; i < kFrames; ++i) simulator.Simulate(i, AboveField());
    });
    std::printf("%8d %24.1f %16.0f\n", boxes, 1e3 * seconds / kFrames, PeakMebibytes());
  }
}

int RunSimBench(const SimBenchArguments& arguments) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a line at a time, into a file too
  const sim::Scene scene =
      arguments.scene.empty() ? sim::MakeScene("desk", 11) : sim::ReadScene(arguments.scene);
  const auto path = sim::MakeTrajectory(scene, arguments.frames, 30.0, 1);
  std::printf("%s: %zu objects, %d frames\n", scene.name.c_str(), scene.objects.size(),
              arguments.frames);
  {
    const sim::Simulator simulator(scene, sim::RigOptions{});
    Print("prints baked, 2 threads", InMemory(simulator, path, 2));
    Print("in memory, 1 thread", InMemory(simulator, path, 1));
    Print("in memory, 2 threads", InMemory(simulator, path, 2));
    std::printf("%-28s %7.0f MiB\n", "peak memory", PeakMebibytes());
  }
  if (arguments.files) {
    Print("with files, 1 thread", WithFiles(scene, path, 1));
    Print("with files, 2 threads", WithFiles(scene, path, 2));
    std::printf("%-28s %7.0f MiB\n", "peak memory", PeakMebibytes());
  }
  const std::size_t few = std::min<std::size_t>(path.size(), 20);
  PrintStages(MeasureStages(scene, {path.begin(), path.begin() + static_cast<long>(few)}), few);
  std::printf("  rolling shutter and blur, fast hand       %6.2f ms, not in the above\n",
              ExposureCost_ms(scene, static_cast<int>(few)));
  if (arguments.most_boxes >= 10) PrintScaling(arguments.most_boxes);
  return kDone;
}

}  // namespace

void AddBenchSim(CLI::App& bench, const Globals&, int& exit_code) {
  CLI::App* command = bench.add_subcommand("sim", kAboutBenchSim);
  const auto arguments = std::make_shared<SimBenchArguments>();
  SimBenchArguments& a = *arguments;
  command->add_option("--scene", a.scene, "Scene file; without it the desk of seed 11");
  command->add_option("--frames", a.frames, "Frames of each run")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--most-boxes", a.most_boxes, "Largest field of boxes; 0: none")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  command->add_flag("--files,!--no-files", a.files, "Write sequences too")
      ->capture_default_str();
  command->callback([arguments, &exit_code] { exit_code = RunSimBench(*arguments); });
}

}  // namespace app
