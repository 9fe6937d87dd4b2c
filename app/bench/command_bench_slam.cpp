#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "app/app.h"
#include "app/bench/bench_slam.h"
#include "app/bench/quantile.h"
#include "app/options/choice_option.h"
#include "app/options/depth_sensor_option.h"
#include "io/folder_kind.h"
#include "slam/model/module_times.h"
#include "slam/run/run_sequence.h"

namespace app {
namespace {

constexpr const char* kAboutBenchSlam =
    "Accuracy, time and memory of pas slam on sequences with truth: frames tracked, ATE, time\n"
    "of each module, whether time and memory stay flat, and how soon a lost camera is found;\n"
    "with mapping between frames and beside tracking.";

constexpr double kWrong_m = 0.05;

struct SlamBenchArguments {
  std::vector<std::string> sequences;
  std::string config_file, mapping = "both", sensor = kAutoSensor;
  BenchOptions bench;
  bool loop_closing = false;
};

double MeanOf(const std::vector<double>& values) {
  return values.empty() ? 0.0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

std::vector<double> Column(const BenchRow& row, std::size_t module) {
  std::vector<double> values;
  for (const auto& frame : row.modules_ms) values.push_back(frame[module]);
  return values;
}

void Print(const BenchRow& row, const char* mapping) {
  constexpr std::size_t kWhole = slam::kModuleCount - 1;
  const std::vector<double> ms = Column(row, kWhole);
  const std::size_t third = ms.size() / 3;
  const std::vector<double> middle(ms.begin() + static_cast<long>(third),
                                   ms.begin() + static_cast<long>(2 * third)),
      last(ms.begin() + static_cast<long>(2 * third), ms.end());
  const auto& ate = row.score.ate_se3;
  fmt::print(
      "{:<14} {:<5} {:>6} {:>7} {:>4} {:>7} {:>7} {:>4} {:>6} {:>6.2f} {:>6.2f} {:>6.2f} "
      "{:>5.2f} {:>7.2f}\n",
      row.name, mapping, row.frames, row.tracked, row.score.lost_events,
      ate ? fmt::format("{:.2f}", 1e3 * ate->rmse) : "-",
      ate ? fmt::format("{:.2f}", 1e3 * row.end_error_m) : "-", row.keyframes, row.points,
      row.run_ms, MeanOf(ms), QuantileOrZero(ms, 0.99),
      MeanOf(middle) > 0 ? MeanOf(last) / MeanOf(middle) : 0.0, row.kib_a_frame);
}

void PrintSummary(const std::vector<BenchRow>& rows) {
  std::vector<double> ate_mm, ms;
  for (const BenchRow& row : rows) {
    if (row.score.ate_se3) ate_mm.push_back(1e3 * row.score.ate_se3->rmse);
    const std::vector<double> some = Column(row, slam::kModuleCount - 1);
    ms.insert(ms.end(), some.begin(), some.end());
  }
  if (!ate_mm.empty()) {
    fmt::print("ATE rmse: median {:.2f} mm, worst {:.2f} mm; ", QuantileOrZero(ate_mm, 0.5),
               QuantileOrZero(ate_mm, 1.0));
  }
  fmt::print("a frame: mean {:.2f} ms, p99 {:.2f} ms\n", MeanOf(ms), QuantileOrZero(ms, 0.99));
}

void PrintModules(const std::vector<BenchRow>& rows) {
  fmt::print("module, ms a frame    mean  median     p99\n");
  for (std::size_t m = 0; m < slam::kModuleCount; ++m) {
    std::vector<double> all;
    for (const BenchRow& row : rows) {
      const std::vector<double> some = Column(row, m);
      all.insert(all.end(), some.begin(), some.end());
    }
    fmt::print("{:<18} {:>7.2f} {:>7.2f} {:>7.2f}\n", slam::kModuleNames[m], MeanOf(all),
               QuantileOrZero(all, 0.5), QuantileOrZero(all, 0.99));
  }
}

void PrintComebacks(const std::vector<BenchRow>& rows) {
  int all = 0, soon = 0, wrong = 0;
  std::vector<double> error_mm;
  for (const BenchRow& row : rows) {
    for (const Comeback& comeback : row.comebacks) {
      ++all;
      soon += comeback.waited >= 0 && comeback.waited <= 10;
      wrong += comeback.error_m > kWrong_m;
      if (comeback.waited >= 0) error_mm.push_back(1e3 * comeback.error_m);
    }
  }
  fmt::print(
      "lost {} times; found within 10 frames of seeing the map again: {}; first pose off by "
      "{:.1f} mm (median), {:.1f} mm (worst); wrong by more than {:.0f} cm: {}\n",
      all, soon, QuantileOrZero(error_mm, 0.5), QuantileOrZero(error_mm, 1.0), 100 * kWrong_m,
      wrong);
  int elsewhere = 0, taken = 0;
  for (const BenchRow& row : rows) elsewhere += row.elsewhere, taken += row.taken;
  if (elsewhere > 0)
    fmt::print("elsewhere: {} of {} frames taken for the map's\n", taken, elsewhere);
}

int RunSlamBench(const SlamBenchArguments& arguments, bool quiet) {
  BenchOptions bench = arguments.bench;
  // Refused before anything runs: the truth of a bag is beside it.
  slam::VariantOf(bench.variant);
  for (const std::string& sequence : arguments.sequences) io::RequireSequence(sequence);
  if (!bench.then.empty()) io::RequireSequence(bench.then);
  fmt::print(
      "{:<14} {:<5} {:>6} {:>7} {:>4} {:>7} {:>7} {:>4} {:>6} {:>6} {:>6} {:>6} {:>5} {:>7}\n",
      "sequence", "map", "frames", "tracked", "lost", "ate mm", "end mm", "kf", "points",
      "run ms", "ms", "p99 ms", "late", "KiB/fr");
  std::vector<BenchRow> sync, async;
  for (const std::string& sequence : arguments.sequences) {
    bench.config =
        ConfigForRecording(arguments.sensor, arguments.config_file, sequence, "", quiet);
    bench.config.loop_closing.enabled |= arguments.loop_closing;
    for (const bool beside : {false, true}) {
      if (arguments.mapping == (beside ? "sync" : "async")) continue;
      bench.config.async_mapping = beside;
      std::vector<BenchRow>& rows = beside ? async : sync;
      rows.push_back(MeasureSlam(sequence, bench));
      Print(rows.back(), beside ? "async" : "sync");
      std::fflush(stdout);
    }
  }
  for (const auto* rows : {&sync, &async}) {
    if (rows->empty()) continue;
    fmt::print("\nmapping {}\n",
               rows == &sync ? "sync: between frames" : "async: beside tracking");
    PrintSummary(*rows);
    PrintModules(*rows);
    PrintComebacks(*rows);
  }
  fmt::print(
      "\n"
      "run ms: the whole run by the clock, a frame, with reading and writing; ms: a frame\n"
      "from its images to its pose; late: mean time of the last third over that of the\n"
      "middle third; end: error of the last pose when the first is laid on the truth;\n"
      "KiB/fr: growth of memory over the second half\n");
  return kDone;
}

}  // namespace

void AddBenchSlam(CLI::App& bench, const Globals& globals, int& exit_code) {
  CLI::App* command = bench.add_subcommand("slam", kAboutBenchSlam);
  const auto arguments = std::make_shared<SlamBenchArguments>();
  command->add_option("SEQ", arguments->sequences, "Sequences to run on")->required();
  command->add_option("--variant", arguments->bench.variant, "As of pas slam")
      ->capture_default_str();
  command->add_option("--config", arguments->config_file, "As of pas slam");
  AddSensorOption(*command, arguments->sensor);
  command->add_option("--threads", arguments->bench.threads, "Of tracking; 0: one a core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  CLI::Option* black =
      command
          ->add_option(
              "--black-every", arguments->bench.black_every,
              "Cover the lens every so many frames, to see how the camera is found again; "
              "detections are not replayed then")
          ->check(CLI::Range(2, 1000000));
  command->add_option("--black-frames", arguments->bench.black_frames, "For so many frames")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command
      ->add_option(
          "--blind-frames", arguments->bench.blind_frames,
          "Cover depth as well, for so many of these frames: then planes alone find the "
          "camera until the lens is free")
      ->check(CLI::Range(1, 1000000))
      ->needs(black);
  CLI::Option* then = command->add_option(
      "--then", arguments->bench.then,
      "Show another sequence of the same camera in the end, to see whether it is "
      "taken for the map");
  command
      ->add_option(
          "--laps", arguments->bench.laps,
          "Play each sequence to and fro so often, to see whether time and memory stay "
          "flat where everything is known; detections are not replayed then")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str()
      ->excludes(then);
  command->add_option("--mapping", arguments->mapping, "sync | async | both; as of pas slam")
      ->check(Choice({"sync", "async", "both"}))
      ->capture_default_str();
  command->add_flag("--loop-closing", arguments->loop_closing, "As of pas slam");
  command->callback([arguments, &globals, &exit_code] {
    exit_code = RunSlamBench(*arguments, globals.quiet);
  });
}

}  // namespace app
