#include <fmt/core.h>

#include <cstdio>
#include <functional>
#include <map>
#include <memory>

#include "app/app.h"
#include "app/bench/bench_sequences.h"
#include "app/bench/wrong_planes.h"
#include "app/options/depth_sensor_option.h"

namespace app {
namespace {

constexpr const char* kAboutBenchWrongPlanes =
    "What wrong matches of planes do: a share of a run's matches is put on another plane of\n"
    "the frame, the one most alike. Errors as ratios of those of the run without (geometric\n"
    "means, 95 % intervals over sequences), and how many of the wrong matches were taken back\n"
    "before the map learnt from them.";

struct WrongPlanesArguments {
  BenchSequenceArguments on;
  std::vector<double> percent{5, 10, 20};
  std::uint64_t seed = 1;
};

struct Damage {
  PairedRatio ate, offset, normal;
  int matches = 0, wrong = 0, taken_back = 0;
};

void Print(double percent, const std::string& kind, const Damage& d) {
  fmt::print("{:>4g} %  {:<28} {:<21} {:<21} {:<21} {:>7} {:>6} {:>6}  {}\n", percent, kind,
             d.ate.Text(), d.offset.Text(), d.normal.Text(), d.matches, d.wrong, d.taken_back,
             d.wrong > 0 ? fmt::format("{:.3f}", double(d.taken_back) / d.wrong) : "-");
  std::fflush(stdout);
}

int RunWrongPlanesBench(const WrongPlanesArguments& arguments) {
  const slam::Config config = ConfigFrom(arguments.on.sensor, arguments.on.config_file);
  const BenchSequences sequences(arguments.on);
  std::vector<BenchErrors> untouched;
  for (const BenchSequence& sequence : sequences.all()) {
    untouched.push_back(ErrorsOf(RunAndScore(sequence, config)));
  }
  fmt::print("{:>6}  {:<28} {:<21} {:<21} {:<21} {:>7} {:>6} {:>6}  {}\n", "wrong", "sequences",
             "ATE", "map offset", "map normal", "matches", "wrong", "back", "recall");
  for (const double percent : arguments.percent) {
    std::map<std::string, Damage> by_kind;
    Damage all;
    for (std::size_t i = 0; i < sequences.all().size(); ++i) {
      const BenchSequence& sequence = sequences.all()[i];
      WrongPlanes wrong(percent / 100.0, arguments.seed);
      slam::TrackerHooks hooks;
      hooks.after_association = std::ref(wrong);
      const ScoredRun run = RunAndScore(sequence, config, hooks);
      const BenchErrors errors = ErrorsOf(run);
      for (Damage* damage : {&by_kind[sequence.kind], &all}) {
        damage->ate.Add(errors.ate_m, untouched[i].ate_m);
        damage->offset.Add(errors.plane_offset_mm, untouched[i].plane_offset_mm);
        damage->normal.Add(errors.plane_normal_deg, untouched[i].plane_normal_deg);
        damage->matches += wrong.matches();
        damage->wrong += static_cast<int>(wrong.made().size());
        damage->taken_back += CountTakenBack(wrong.made(), run.frames);
      }
    }
    for (const auto& [kind, damage] : by_kind) Print(percent, kind, damage);
    if (by_kind.size() > 1) Print(percent, "all", all);
  }
  return kDone;
}

}  // namespace

void AddBenchWrongPlanes(CLI::App& bench, const Globals& /*globals*/, int& exit_code) {
  CLI::App* command = bench.add_subcommand("wrong-planes", kAboutBenchWrongPlanes);
  const auto arguments = std::make_shared<WrongPlanesArguments>();
  AddBenchSequenceOptions(*command, arguments->on);
  command->add_option("--percent", arguments->percent, "Of the matches that are made wrong")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Which ones")->capture_default_str();
  command->callback([arguments, &exit_code] { exit_code = RunWrongPlanesBench(*arguments); });
}

}  // namespace app
