#include "app/bench/bench_sequences.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <ctime>
#include <map>
#include <system_error>

#include "app/options/depth_sensor_option.h"
#include "app/sim/sim_arguments.h"
#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"
#include "eval/regression/paired_tests.h"
#include "sim/families/families.h"
#include "sim/write/write_sequence.h"
#include "slam/run/run_sequence.h"

namespace app {
namespace {

namespace fs = std::filesystem;

struct DrawnKind {
  const char *kind, *family;
  std::map<std::string, double> parameters;
};

const std::vector<DrawnKind>& DrawnKinds() {
  static const std::vector<DrawnKind> kinds = {
      {"textured", "desk", {}},
      {"texture-poor", "desk", {{"texture", 0.1}}},
      {"ambiguous", "stack", {}},
  };
  return kinds;
}

}  // namespace

ScratchFolder::ScratchFolder(const char* name)
    : path_(fs::temp_directory_path() / fmt::format("pas_bench_{}_{}", name, ::getpid())) {}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void AddBenchSequenceOptions(CLI::App& command, BenchSequenceArguments& a) {
  command.add_option("SEQ", a.folders,
                     "Sequences with truth, simulated or real; none: scenes are drawn");
  command.add_option("--seeds", a.seeds, "Scenes of each kind that are drawn")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command.add_option("--first-seed", a.first_seed, "Of the scenes")->capture_default_str();
  command.add_option("--frames", a.frames, "Of each scene")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  command.add_option("--sim-sensor", a.sim_sensor, "That scenes are recorded with")
      ->capture_default_str();
  AddSensorOption(command, a.sensor);
  command.add_option("--config", a.config_file, "As of pas slam");
}

BenchSequences::BenchSequences(const BenchSequenceArguments& arguments) {
  for (const std::string& folder : arguments.folders) {
    const fs::path path = fs::path(folder).lexically_normal();
    all_.push_back({(path.has_filename() ? path : path.parent_path()).filename(), path});
  }
  if (!all_.empty()) return;
  drawn_.emplace("scenes");
  for (const DrawnKind& kind : DrawnKinds()) {
    for (int i = 0; i < arguments.seeds; ++i) {
      SimArguments sim;
      sim.seed = arguments.first_seed + static_cast<std::uint64_t>(i);
      sim.frames = arguments.frames;
      sim.sensor = arguments.sim_sensor;
      sim.force = true;
      const sim::Scene scene = sim::MakeScene(kind.family, sim.seed, kind.parameters);
      const fs::path folder = drawn_->path() / fmt::format("{}-{}", kind.kind, sim.seed);
      fs::create_directories(drawn_->path());
      sim::WriteSequence(scene, OptionsOf(sim, scene), folder);
      all_.push_back({kind.kind, folder});
    }
  }
}

ScoredRun RunAndScore(const BenchSequence& sequence, const slam::Config& config,
                      const slam::TrackerHooks& hooks) {
  const ScratchFolder scratch("run");
  const fs::path& folder = scratch.path();
  slam::RunOptions options;
  options.sequence = sequence.folder;
  options.run = folder;
  options.config = config;
  options.threads = 1;
  options.force = true;
  options.save_segmentation = true;
  options.hooks = hooks;
  ScoredRun scored;
  const std::clock_t start = std::clock();
  slam::RunSequence(options);
  scored.cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  eval::Run run = eval::ReadRun(folder);
  scored.evaluation = eval::Evaluate(run, eval::ReadSequence(sequence.folder));
  scored.frames = std::move(run.frames);
  return scored;
}

BenchErrors ErrorsOf(const ScoredRun& run) {
  const auto median = [](const std::optional<eval::Spread>& spread) {
    return spread ? std::optional(spread->median) : std::nullopt;
  };
  BenchErrors errors;
  errors.ate_m = run.evaluation.trajectory.ate_complete_rmse_m;
  if (!run.evaluation.planes || !run.evaluation.planes->map) return errors;
  const eval::MapScore& map = *run.evaluation.planes->map;
  errors.plane_offset_mm = median(map.offset_mm);
  errors.plane_normal_deg = median(map.normal_deg);
  errors.vertex_mm = median(map.vertex_mm);
  return errors;
}

void PairedRatio::Add(const std::optional<double>& value, const std::optional<double>& base) {
  if (value && base && *value > 0.0 && *base > 0.0) logs.push_back(std::log(*value / *base));
}

double PairedRatio::Mean() const {
  double sum = 0.0;
  for (const double log : logs) sum += log;
  return logs.empty() ? 1.0 : std::exp(sum / static_cast<double>(logs.size()));
}

std::string PairedRatio::Text() const {
  constexpr std::size_t kResamples = 2000;  // the interval's ends to some parts in a hundred
  if (logs.empty()) return "-";
  const eval::ConfidenceInterval interval =
      eval::BootstrapMeanInterval(logs, eval::DrawResamples(logs.size(), kResamples), 0.95);
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", Mean(), std::exp(interval.low),
                     std::exp(interval.high));
}

}  // namespace app
