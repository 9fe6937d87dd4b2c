#include <fmt/core.h>

#include <array>
#include <cstdio>
#include <map>
#include <memory>

#include "app/app.h"
#include "app/bench/bench_sequences.h"
#include "app/options/depth_sensor_option.h"

namespace app {
namespace {

constexpr const char* kAboutBenchFactors =
    "What each factor of the pose and of the bundle adjustment is worth: errors and processor\n"
    "time without it, as a ratio of those with it; above 1 it helps. Geometric means with\n"
    "95 % intervals over sequences, by kind and over all.";

struct FactorSwitch {
  const char* name;
  bool& (*in)(slam::Config& config);
};

constexpr std::array<FactorSwitch, 10> kFactors = {{
    {"pose: point (eq14)",
     [](slam::Config& c) -> bool& { return c.point_search.pose.use_points; }},
    {"pose: plane-plane (eq15, eq16)",
     [](slam::Config& c) -> bool& { return c.point_search.pose.use_planes; }},
    {"pose: box-plane (eq17)",
     [](slam::Config& c) -> bool& { return c.point_search.pose.use_boxes; }},
    {"pose: point-plane (eq18)",
     [](slam::Config& c) -> bool& { return c.point_search.pose.use_point_planes; }},
    {"pose: vertex", [](slam::Config& c) -> bool& { return c.point_search.pose.use_vertices; }},
    {"bundle: plane-plane (eq16)",
     [](slam::Config& c) -> bool& { return c.mapping.bundle.use_planes; }},
    {"bundle: point-plane (eq18)",
     [](slam::Config& c) -> bool& { return c.mapping.bundle.use_point_planes; }},
    {"bundle: points told in planes",
     [](slam::Config& c) -> bool& { return c.mapping.bundle.use_coplanar_points; }},
    {"bundle: edges (eq16)",
     [](slam::Config& c) -> bool& { return c.mapping.bundle.use_edges; }},
    {"bundle: vertex", [](slam::Config& c) -> bool& { return c.mapping.bundle.use_vertices; }},
}};

/// A factor buys something where it makes an error smaller by half a percent.
constexpr double kWorth = 1.005;

struct FactorRatios {
  PairedRatio ate, offset, normal, vertex, time;

  void Add(const ScoredRun& without, const ScoredRun& with) {
    const BenchErrors a = ErrorsOf(without), b = ErrorsOf(with);
    ate.Add(a.ate_m, b.ate_m);
    offset.Add(a.plane_offset_mm, b.plane_offset_mm);
    normal.Add(a.plane_normal_deg, b.plane_normal_deg);
    vertex.Add(a.vertex_mm, b.vertex_mm);
    time.Add(without.cpu_s, with.cpu_s);
  }
  bool Helps() const {
    for (const PairedRatio* ratio : {&ate, &offset, &normal, &vertex}) {
      if (ratio->Mean() > kWorth) return true;
    }
    return false;
  }
};

void Print(const char* factor, bool by_default, const std::string& kind,
           const FactorRatios& ratios) {
  fmt::print("{:<31} {:<4} {:<14} {:<21} {:<21} {:<21} {:<21} {}\n", factor,
             by_default ? "on" : "off", kind, ratios.ate.Text(), ratios.offset.Text(),
             ratios.normal.Text(), ratios.vertex.Text(), ratios.time.Text());
  std::fflush(stdout);
}

int RunFactorBench(const BenchSequenceArguments& arguments) {
  slam::Config config = ConfigFrom(arguments.sensor, arguments.config_file);
  const BenchSequences sequences(arguments);
  std::vector<ScoredRun> as_it_is;
  for (const BenchSequence& sequence : sequences.all()) {
    as_it_is.push_back(RunAndScore(sequence, config));
  }
  fmt::print("{:<31} {:<4} {:<14} {:<21} {:<21} {:<21} {:<21} {}\n", "factor", "", "sequences",
             "ATE", "map offset", "map normal", "map vertex", "time");
  std::string no_help;
  for (const FactorSwitch& factor : kFactors) {
    slam::Config other = config;
    bool& uses = factor.in(other);
    const bool by_default = uses;
    uses = !uses;
    std::map<std::string, FactorRatios> by_kind;
    FactorRatios all;
    for (std::size_t i = 0; i < sequences.all().size(); ++i) {
      const BenchSequence& sequence = sequences.all()[i];
      const ScoredRun changed = RunAndScore(sequence, other);
      const ScoredRun& without = by_default ? changed : as_it_is[i];
      const ScoredRun& with = by_default ? as_it_is[i] : changed;
      for (FactorRatios* ratios : {&by_kind[sequence.kind], &all}) ratios->Add(without, with);
    }
    bool helps = false;
    for (const auto& [kind, ratios] : by_kind) {
      Print(factor.name, by_default, kind, ratios);
      helps = helps || ratios.Helps();
    }
    if (by_kind.size() > 1) Print(factor.name, by_default, "all", all);
    if (!helps) no_help += fmt::format("{}{}", no_help.empty() ? "" : "; ", factor.name);
  }
  fmt::print(
      "\non, off: by default. Nowhere an error smaller by half a percent: {}\n"
      "The paper's plane-point and plane-vertex terms are those of eq18 and eq17; points in "
      "the bundle\n"
      "cannot be switched off, as its windows are made of them. eq19 and eq20: pas bench "
      "structure.\n",
      no_help.empty() ? "none" : no_help);
  return kDone;
}

}  // namespace

void AddBenchFactors(CLI::App& bench, const Globals& /*globals*/, int& exit_code) {
  CLI::App* command = bench.add_subcommand("factors", kAboutBenchFactors);
  const auto arguments = std::make_shared<BenchSequenceArguments>();
  AddBenchSequenceOptions(*command, *arguments);
  command->callback([arguments, &exit_code] { exit_code = RunFactorBench(*arguments); });
}

}  // namespace app
