#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "app/app.h"
#include "app/console.h"
#include "app/eval_modes.h"
#include "eval/formats/run.h"
#include "eval/formats/sequence.h"
#include "eval/report/evaluate.h"
#include "eval/report/metrics_json.h"
#include "eval/report/table.h"
#include "eval/surfaces/report_surfaces.h"
#include "io/input_error.h"
#include "io/output_file.h"

namespace app {
namespace {

/// One line for each kind of fault that the figures can live with.
void PrintWarnings(const std::vector<eval::Fault>& faults,
                   const std::filesystem::path& folder) {
  for (const std::string& line : eval::Summaries(faults, folder)) {
    PrintWarning(line);
  }
}

int EvalRun(const EvalOptions& options, const Globals& globals) {
  const eval::Run run = eval::ReadRun(options.run);
  const std::filesystem::path truth =
      options.truth.empty() ? eval::SequenceOf(run) : std::filesystem::path(options.truth);
  // The default is what an earlier call wrote.
  constexpr const char* kMetrics = "metrics.json";
  const bool by_default = options.output.empty();
  const std::filesystem::path output =
      by_default ? run.folder / kMetrics : std::filesystem::path(options.output);
  const io::OutputFile file(output,
                            {options.force || by_default, {run.folder, truth}, kMetrics});
  const eval::Sequence sequence = eval::ReadSequence(truth);
  const eval::Evaluation evaluation = eval::Evaluate(run, sequence);
  PrintWarnings(evaluation.run_warnings, run.folder);
  PrintWarnings(evaluation.sequence_warnings, sequence.folder);

  const auto surfaces = ScoreOnSurfaces(run, sequence, options.surfaces, options.force);
  nlohmann::ordered_json metrics = eval::MetricsJson(evaluation);
  if (surfaces) eval::AddSurfaces(*surfaces, options.surfaces.file, metrics);
  file.Write(metrics.dump(2) + "\n");
  if (!globals.quiet) {
    std::fputs(eval::MetricsTable(evaluation).c_str(), stdout);
    if (surfaces) std::fputs(eval::SurfacesTable(*surfaces).c_str(), stdout);
    std::printf("wrote %s\n", output.c_str());
  }
  if (evaluation.trajectory.tracked > 0) return kDone;
  std::fprintf(stderr, "pas eval: %s tracked none of %zu frames\n", run.folder.c_str(),
               evaluation.trajectory.frames);
  return kFailure;
}

int Eval(const EvalOptions& options, const Globals& globals) {
  if (!options.trajectory.files.empty()) {
    if (!options.run.empty()) {
      throw io::InputError(options.run,
                           "stands beside --trajectory; name either a run or files "
                           "of poses");
    }
    return EvalTrajectories(options, globals);
  }
  if (options.run.empty()) {
    throw io::InputError("pas eval",
                         "needs a RUN folder, or --trajectory FILE; see pas eval "
                         "--help");
  }
  return EvalRun(options, globals);
}

}  // namespace

void AddEvalCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  const auto options = std::make_shared<EvalOptions>();
  CLI::App* command = pas.add_subcommand(
      "eval",
      "Score a run against the truth: trajectory (metres, degrees), association of planes,\n"
      "planes and vertices of each frame, map (millimetres, degrees), time (milliseconds).\n"
      "A sequence without gt/ gives trajectory and time only; a run without segmentation/\n"
      "images (pas slam --save-segmentation) gives nothing that is counted by pixels.\n"
      "What cannot be scored is refused; what should be known beside the figures is a "
      "warning.\n"
      "With --trajectory, bare files of poses are scored, as evo does it.\n"
      "Exit code 1 if the run tracked no frame.");
  command->add_option("RUN", options->run, "Run folder, as pas slam writes it");
  command->add_option(
      "--truth", options->truth,
      "Sequence folder with the truth (default: the one that RUN/run.json names, "
      "relative to RUN, to the folder above or to here, else where it was)");
  command->add_option("-o,--output", options->output,
                      "File to write, which must not exist (default: RUN/metrics.json, which "
                      "replaces an older one; with --trajectory none)");
  command->add_flag("--force", options->force, "Replace the file of -o when it exists");
  AddSurfacesOption(*command, options->surfaces);
  AddTrajectoryOptions(*command, options->trajectory);
  command->callback([options, &globals, &exit_code] { exit_code = Eval(*options, globals); });
}

}  // namespace app
