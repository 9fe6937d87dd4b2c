#include <fmt/core.h>

#include <cstdio>
#include <map>
#include <memory>

#include "app/app.h"
#include "app/bench/bench_sequences.h"
#include "app/options/depth_sensor_option.h"
#include "slam/structure/structure.h"

namespace app {
namespace {

constexpr const char* kAboutBenchStructure =
    "What each assumption of how planes stand to each other (pas slam --structure) is worth:\n"
    "errors and processor time with it, as a ratio of those without any; below 1 it helps.\n"
    "Geometric means with 95 % intervals over sequences, by kind and over all; frames tracked\n"
    "with it and without.";

struct StructureRatios {
  PairedRatio ate, offset, normal, time;
  std::size_t tracked = 0, tracked_without = 0;  ///< frames

  void Add(const ScoredRun& with, const ScoredRun& without) {
    const BenchErrors a = ErrorsOf(with), b = ErrorsOf(without);
    ate.Add(a.ate_m, b.ate_m);
    offset.Add(a.plane_offset_mm, b.plane_offset_mm);
    normal.Add(a.plane_normal_deg, b.plane_normal_deg);
    time.Add(with.cpu_s, without.cpu_s);
    tracked += with.evaluation.trajectory.tracked;
    tracked_without += without.evaluation.trajectory.tracked;
  }
};

void Print(const std::string& mode, const std::string& kind, const StructureRatios& ratios) {
  fmt::print("{:<10} {:<16} {:<21} {:<21} {:<21} {:<21} {}, {}\n", mode, kind,
             ratios.ate.Text(), ratios.offset.Text(), ratios.normal.Text(), ratios.time.Text(),
             ratios.tracked, ratios.tracked_without);
  std::fflush(stdout);
}

int RunStructureBench(const BenchSequenceArguments& arguments) {
  slam::Config config = ConfigFrom(arguments.sensor, arguments.config_file);
  config.structure.mode = slam::StructureMode::kFree;
  const BenchSequences sequences(arguments);
  std::vector<ScoredRun> without;
  for (const BenchSequence& sequence : sequences.all()) {
    without.push_back(RunAndScore(sequence, config));
  }
  fmt::print("{:<10} {:<16} {:<21} {:<21} {:<21} {:<21} {}\n", "structure", "sequences", "ATE",
             "map offset", "map normal", "time", "tracked");
  const std::vector<std::string>& names = slam::StructureModeNames();
  for (std::size_t mode = 1; mode < names.size(); ++mode) {
    config.structure.mode = static_cast<slam::StructureMode>(mode);
    std::map<std::string, StructureRatios> by_kind;
    StructureRatios all;
    for (std::size_t i = 0; i < sequences.all().size(); ++i) {
      const BenchSequence& sequence = sequences.all()[i];
      const ScoredRun with = RunAndScore(sequence, config);
      for (StructureRatios* ratios : {&by_kind[sequence.kind], &all})
        ratios->Add(with, without[i]);
    }
    for (const auto& [kind, ratios] : by_kind) Print(names[mode], kind, ratios);
    if (by_kind.size() > 1) Print(names[mode], "all", all);
  }
  return kDone;
}

}  // namespace

void AddBenchStructure(CLI::App& bench, const Globals& /*globals*/, int& exit_code) {
  CLI::App* command = bench.add_subcommand("structure", kAboutBenchStructure);
  const auto arguments = std::make_shared<BenchSequenceArguments>();
  AddBenchSequenceOptions(*command, *arguments);
  command->callback([arguments, &exit_code] { exit_code = RunStructureBench(*arguments); });
}

}  // namespace app
