#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "app/app.h"
#include "app/surfaces_option.h"
#include "eval/formats/run.h"
#include "eval/formats/sequence.h"
#include "eval/report/evaluate.h"
#include "eval/report/metrics_json.h"
#include "eval/report/table.h"
#include "eval/surfaces/report_surfaces.h"
#include "io/atomic_file.h"

namespace app {
namespace {

struct EvalOptions {
  std::string run;
  std::string truth;
  std::string output;
  SurfacesOption surfaces;
};

int RunEval(const EvalOptions& options, const Globals& globals) {
  const eval::Run run = eval::ReadRun(options.run);
  const std::filesystem::path truth =
      options.truth.empty() ? eval::SequenceOf(run) : std::filesystem::path(options.truth);
  const eval::Sequence sequence = eval::ReadSequence(truth);
  const eval::Evaluation evaluation = eval::Evaluate(run, sequence);

  const auto surfaces = ScoreOnSurfaces(run, sequence, options.surfaces);

  const std::filesystem::path output = options.output.empty()
                                           ? run.folder / "metrics.json"
                                           : std::filesystem::path(options.output);
  nlohmann::ordered_json metrics = eval::MetricsJson(evaluation);
  if (surfaces) eval::AddSurfaces(*surfaces, options.surfaces.file, metrics);
  io::WriteFile(output, metrics.dump(2) + "\n");
  if (!globals.quiet) {
    std::fputs(eval::MetricsTable(evaluation).c_str(), stdout);
    if (surfaces) std::fputs(eval::SurfacesTable(*surfaces).c_str(), stdout);
    std::printf("wrote %s\n", output.c_str());
  }
  if (evaluation.tracked > 0) return kDone;
  std::fprintf(stderr, "pas eval: %s tracked none of %zu frames\n", run.folder.c_str(),
               evaluation.frames);
  return kFailure;
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
      "Exit code 1 if the run tracked no frame.");
  command->add_option("RUN", options->run, "Run folder, as pas slam writes it")->required();
  command->add_option(
      "--truth", options->truth,
      "Sequence folder with the truth (default: the one that RUN/run.json names, "
      "as written or relative to RUN)");
  command->add_option("-o,--output", options->output,
                      "File to write (default: RUN/metrics.json); an older one is replaced");
  AddSurfacesOption(*command, options->surfaces);
  command->callback(
      [options, &globals, &exit_code] { exit_code = RunEval(*options, globals); });
}

}  // namespace app
