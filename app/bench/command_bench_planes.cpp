#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/app.h"
#include "app/bench/bench_planes.h"
#include "app/bench/quantile.h"
#include "app/console/console.h"
#include "app/options/depth_sensor_option.h"
#include "app/options/segmentation_option.h"
#include "slam/run/config_file.h"

namespace app {
namespace {

struct PlaneBenchArguments {
  std::vector<std::string> sequences;
  std::string camera, config_file, surfaces;
  std::string sensor = kAutoSensor;
  std::optional<slam::Segmentation> segmentation;
  int frames = 0, every = 1;
  bool steps = false, unmeasured = false;
  double depth_delay_ms = 0.0;
};

double Ratio(int part, int whole) {
  return whole > 0 ? static_cast<double>(part) / whole : 0.0;
}

void PrintHeader() {
  fmt::print(
      "{:14} {:>6} {:>7} {:>6} {:>6} {:>6} {:>6} {:>6} {:>5} {:>5} {:>6} {:>6} {:>6} "
      "{:>6} {:>5} {:>5} {:>6}\n",
      "", "truth", "correct", "over", "merged", "missed", "noise", "PQ", "thin", "n deg",
      "d mm", "v rec", "v prec", "v mm", "p95", "four", "segs");
}

void PrintScores(const std::string& name, const PlaneBench& b) {
  const eval::HooverScore& h = b.hoover;
  const eval::CornerCounts& c = b.corners;
  fmt::print(
      "{:14} {:6.2f} {:7.3f} {:6.3f} {:6.3f} {:6.3f} {:6.3f} {:6.3f} {:5.3f} {:5.2f} "
      "{:6.2f} {:6.3f} {:6.3f} {:6.2f} {:5.1f} {:5.2f} {:6.1f}\n",
      name, Ratio(h.truth, b.scored_frames), Ratio(h.correct, h.truth), Ratio(h.over, h.truth),
      Ratio(b.Merged(), h.truth), Ratio(h.missed, h.truth), Ratio(h.noise, h.truth),
      b.panoptic.Pq(), b.thin_tops.Ratio(), QuantileOrZero(b.normal_deg, 0.5),
      QuantileOrZero(b.offset_mm, 0.5), Ratio(c.found_in_view, c.true_in_view),
      Ratio(c.matched, c.claimed), QuantileOrZero(c.errors_mm, 0.5),
      QuantileOrZero(c.errors_mm, 0.95), Ratio(c.faces_with_4, c.faces_in_view),
      Ratio(b.segments, b.frames));
}

void PrintLevelPlane(const std::string& name, const PlaneBench& b) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& n : b.level_normals_w) mean += n;
  double most_deg = 0.0;
  for (const Eigen::Vector3d& n : b.level_normals_w) {
    most_deg = std::max(most_deg, slam::Angle(n, mean) * 180.0 / std::numbers::pi);
  }
  fmt::print(
      "{}: largest level plane in {} of {} frames, {:.0f} to {:.0f} % of the measured "
      "pixels, normal within {:.2f} deg of its mean; {:.1f} segments a frame\n",
      name, b.level_normals_w.size(), b.frames, 100.0 * QuantileOrZero(b.level_shares, 0.0),
      100.0 * QuantileOrZero(b.level_shares, 1.0), most_deg, Ratio(b.segments, b.frames));
}

void PrintTimes(const PlaneTimes& t) {
  const double plain = QuantileOrZero(t.plain_pass_ms, 0.5);
  fmt::print(
      "\nProcessor time a frame, one thread, ms      median    p95   ratio to a plain pass\n");
  const auto line = [&](const char* name, const std::vector<double>& ms) {
    fmt::print("  {:40}{:7.2f}{:7.2f}{:9.1f}\n", name, QuantileOrZero(ms, 0.5),
               QuantileOrZero(ms, 0.95), QuantileOrZero(ms, 0.5) / std::max(plain, 1e-9));
  };
  line("plain pass: depth read, points written", t.plain_pass_ms);
  line("extraction with edges", t.extraction_ms);
  line("processing", t.processing_ms);
}

void PrintSteps(const StepTable& steps) {
  fmt::print("\nTop faces separated from what they lie on, by step and distance\n");
  fmt::print("  step from mm  distance from m  separated     of\n");
  for (const auto& [bin, share] : steps) {
    fmt::print("  {:12} {:16.1f} {:10.3f} {:6}\n", bin.first, 0.1 * bin.second, share.Ratio(),
               share.all);
  }
}

/// The smallest step whose tops are separated in this share of cases, and all higher ones of
/// that distance together too.
constexpr double kSeparatedShare = 0.95;

void PrintSmallestSteps(const StepTable& steps) {
  fmt::print("\nSmallest step from which on {:.0f} % of top faces are separated\n",
             100.0 * kSeparatedShare);
  fmt::print("  distance from m   step from mm   faces of that step or more\n");
  std::map<int, std::map<int, Share>> by_distance;
  for (const auto& [bin, share] : steps) by_distance[bin.second][bin.first] = share;
  for (const auto& [distance_dm, shares] : by_distance) {
    Share above;
    std::string smallest = "none";
    int faces = 0;
    for (auto it = shares.rbegin(); it != shares.rend(); ++it) {
      above.found += it->second.found, above.all += it->second.all;
      if (it->second.Ratio() < kSeparatedShare || above.Ratio() < kSeparatedShare) continue;
      smallest = std::to_string(it->first);
      faces = above.all;
    }
    fmt::print("  {:15.1f} {:>14} {:>14}\n", 0.1 * distance_dm, smallest, faces);
  }
}

void PrintSurfaces(const std::string& name, const eval::SurfaceFigures& f) {
  fmt::print("{}: surfaces whole {:.3f}, covered {:.3f}, purity {:.3f}, {:.1f} segments\n",
             name, f.whole, f.covered, f.purity, f.segments_per_frame);
}

PlaneBench BenchAll(const PlaneBenchArguments& arguments, bool quiet) {
  PlaneBench sum;
  Progress progress("bench planes", static_cast<int>(arguments.sequences.size()), quiet);
  int done = 0;
  for (const std::string& sequence : arguments.sequences) {
    slam::Config config = ConfigForRecording(arguments.sensor, arguments.config_file, sequence,
                                             arguments.camera, quiet);
    if (arguments.segmentation) config.plane_extraction.segmentation = *arguments.segmentation;
    const PlaneBench bench =
        BenchPlanes(sequence, arguments.camera, config,
                    {arguments.frames, arguments.every, arguments.unmeasured,
                     arguments.depth_delay_ms, arguments.surfaces});
    if (done == 0) PrintHeader();  // a table that nothing stands in is no answer
    const std::string name = std::filesystem::path(sequence).lexically_normal().filename();
    if (bench.scored_frames > 0) PrintScores(name, bench);
    if (!bench.level_normals_w.empty()) PrintLevelPlane(name, bench);
    if (bench.surfaces) PrintSurfaces(name, *bench.surfaces);
    sum.Add(bench);
    progress.Update(++done);
  }
  return sum;
}

int RunBench(const PlaneBenchArguments& arguments, bool quiet) {
  const PlaneBench sum = BenchAll(arguments, quiet);
  if (sum.scored_frames > 0) PrintScores("all", sum);
  PrintTimes(sum.times);
  if (arguments.steps) PrintSteps(sum.steps), PrintSmallestSteps(sum.steps);
  return kDone;
}

}  // namespace

void AddBenchPlanes(CLI::App& bench, const Globals& globals, int& exit_code) {
  CLI::App* command = bench.add_subcommand(
      "planes", "Time extraction and processing of planes, and score them against the truth");
  auto arguments = std::make_shared<PlaneBenchArguments>();
  command->add_option("SEQ", arguments->sequences, "Sequence folders")->required();
  command->add_option("--camera", arguments->camera,
                      "tum1 | tum2 | tum3 | a camera.yaml; default: SEQ/camera.yaml");
  AddSensorOption(*command, arguments->sensor);
  AddSegmentationOption(*command, arguments->segmentation);
  command->add_option("--config", arguments->config_file, "Settings over the defaults, YAML");
  command->add_option("--frames", arguments->frames, "At most so many of each; 0 = all")
      ->check(CLI::Range(0, 1000000));
  command->add_option("--every", arguments->every, "Only every so-manieth frame")
      ->check(CLI::Range(1, 1000000));
  command->add_flag("--steps", arguments->steps,
                    "Also: which steps are separated, by height and distance");
  command->add_flag("--unmeasured", arguments->unmeasured,
                    "Score against true pixels without depth too, as pas eval does");
  command
      ->add_option("--depth-delay-ms", arguments->depth_delay_ms,
                   "Of a recording: its depth is stamped so much later than its true poses")
      ->check(CLI::Range(-1000.0, 1000.0))
      ->capture_default_str();
  command
      ->add_option("--surfaces", arguments->surfaces,
                   "Of a recording: score segments on the surfaces of this file of `pas "
                   "surfaces`")
      ->type_name("FILE");
  command->callback(
      [arguments, &globals, &exit_code] { exit_code = RunBench(*arguments, globals.quiet); });
}

}  // namespace app
