#include "app/eval/trajectory_options.h"

#include <cmath>
#include <map>

#include "app/options/choice_option.h"
#include "io/input_error.h"
#include "io/number_text.h"

namespace app {
namespace {

/// "1f", "0.5m", "1s", "10deg".
eval::PoseDelta DeltaOf(const std::string& text) {
  const std::map<std::string, eval::DeltaUnit> units = {{"f", eval::DeltaUnit::kFrames},
                                                        {"m", eval::DeltaUnit::kMetres},
                                                        {"s", eval::DeltaUnit::kSeconds},
                                                        {"deg", eval::DeltaUnit::kDegrees}};
  const std::size_t end = text.find_last_of("0123456789.") + 1;  // 0 when there is no number
  const auto value = io::ParseNumber(text.substr(0, end));
  const auto unit = units.find(text.substr(end));
  constexpr double kMaxDelta = 1e9;  // of any unit; more frames than any file has
  if (!value || !(*value > 0.0 && *value <= kMaxDelta) || unit == units.end()) {
    throw io::InputError("--delta",
                         "expected a number above 0 with a unit, as 1f, 1m, 1s or 10deg, "
                         "found " +
                             io::Quoted(text));
  }
  if (unit->second == eval::DeltaUnit::kFrames && *value != std::floor(*value)) {
    throw io::InputError("--delta", "expected a whole number of frames, found " +
                                        io::Quoted(text) + "; write it as 1f or 30f");
  }
  return {*value, unit->second};
}

}  // namespace

void AddTrajectoryOptions(CLI::App& command, TrajectoryOptions& options) {
  CLI::Option* files = command.add_option(
      "--trajectory", options.files,
      "Files of poses instead of a RUN: TUM's `t tx ty tz qx qy qz qw`, KITTI's twelve numbers "
      "a line, or EuRoC's csv, told apart by what stands in them. --truth names a file of "
      "poses too. Figures are those of evo (docs/evaluation.md)");
  files->expected(1, 1000)->type_name("FILE...");
  command
      .add_option("--align", options.rules.align,
                  "With --trajectory: none, origin (first pose on first pose), se3 or sim3 "
                  "(least squares of positions)")
      ->needs(files)
      ->transform(ChoiceOf<eval::AlignMode>({{"none", eval::AlignMode::kNone},
                                             {"origin", eval::AlignMode::kOrigin},
                                             {"se3", eval::AlignMode::kSe3},
                                             {"sim3", eval::AlignMode::kSim3}}))
      ->default_str("se3");
  command
      .add_option("--max-dt", options.rules.max_difference_s,
                  "With --trajectory: seconds that matched stamps may differ by")
      ->needs(files)
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command
      .add_option("--delta", options.delta,
                  "With --trajectory: distance of the two poses of a relative error: frames "
                  "(1f), metres (1m), seconds (1s) or degrees (10deg)")
      ->needs(files)
      ->capture_default_str();
  command
      .add_flag("--all-pairs", options.all_pairs,
                "With --trajectory: relative errors of all such pairs, not of consecutive ones")
      ->needs(files);
  command
      .add_flag("--pairs-from-truth", options.rules.pairs_from_truth,
                "With --trajectory: metres and degrees of --delta along the truth, so that all "
                "estimates are scored on the same pairs")
      ->needs(files);
  command
      .add_option("--plane", options.rules.plane,
                  "With --trajectory: project both to this plane after the alignment: xy, xz, "
                  "yz")
      ->needs(files)
      ->transform(ChoiceOf<eval::ProjectionPlane>({{"xy", eval::ProjectionPlane::kXy},
                                                   {"xz", eval::ProjectionPlane::kXz},
                                                   {"yz", eval::ProjectionPlane::kYz}}));
}

eval::ComparisonRules RulesOf(const TrajectoryOptions& options) {
  eval::ComparisonRules rules = options.rules;
  rules.delta = DeltaOf(options.delta);
  if (options.all_pairs) rules.pairs = eval::PairMode::kAll;
  return rules;
}

}  // namespace app
