#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/app.h"
#include "app/console/console.h"
#include "app/eval/eval_modes.h"
#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"
#include "eval/report/evaluate.h"
#include "eval/report/metrics_json.h"
#include "eval/report/run_tables.h"
#include "eval/report/table.h"
#include "eval/surfaces/report_surfaces.h"
#include "io/input_error.h"
#include "io/output_file.h"

namespace app {
namespace {

/// Files beside the figures, refused before the work.
class RunTables {
 public:
  RunTables(const EvalOptions& options, const std::vector<std::filesystem::path>& inputs)
      : as_json_lines_(options.events.ends_with(".jsonl")) {
    if (!options.frames.empty()) {
      frames_.emplace(options.frames, io::OutputRules{options.force, inputs});
    }
    if (!options.events.empty()) {
      events_.emplace(options.events, io::OutputRules{options.force, inputs});
    }
  }
  void AddTo(std::vector<io::OutputFile::Content>& contents, const eval::Evaluation& evaluation,
             const eval::Run& run, const eval::Sequence& sequence,
             const std::optional<eval::SurfaceScore>& surfaces) const {
    if (frames_) contents.push_back({&*frames_, eval::FramesCsv(evaluation, run, sequence)});
    if (!events_) return;
    const std::vector<eval::RunEvent> events = eval::EventsOf(
        evaluation, sequence, surfaces ? surfaces->events : std::vector<eval::RunEvent>());
    contents.push_back(
        {&*events_, as_json_lines_ ? eval::EventsJsonLines(events) : eval::EventsCsv(events)});
  }

 private:
  bool as_json_lines_;
  std::optional<io::OutputFile> frames_, events_;
};

int EvalRun(const EvalOptions& options, const Globals& globals) {
  const eval::Run run = eval::ReadRun(options.run);
  const std::filesystem::path truth =
      options.truth.empty() ? eval::SequenceOf(run) : std::filesystem::path(options.truth);
  // The default is what an earlier call wrote.
  constexpr const char* kMetrics = "metrics.json";
  const bool by_default = options.output.empty();
  const std::filesystem::path output =
      by_default ? run.folder / kMetrics : std::filesystem::path(options.output);
  io::RefuseSameFile({output, options.frames, options.events});
  const io::OutputFile file(output,
                            {options.force || by_default, {run.folder, truth}, kMetrics});
  const RunTables tables(options, {run.folder, truth});
  const eval::Sequence sequence = eval::ReadSequence(truth);
  const eval::Evaluation evaluation = eval::Evaluate(run, sequence);
  PrintWarnings(evaluation.run_warnings, run.folder);
  PrintWarnings(evaluation.sequence_warnings, sequence.folder);

  const auto surfaces = ScoreOnSurfaces(run, sequence, options.surfaces, options.force);
  nlohmann::ordered_json metrics = eval::MetricsJson(evaluation);
  if (surfaces) eval::AddSurfaces(*surfaces, options.surfaces.file, metrics);
  std::vector<io::OutputFile::Content> contents{{&file, metrics.dump(2) + "\n"}};
  tables.AddTo(contents, evaluation, run, sequence, surfaces);
  io::OutputFile::WriteTogether(contents);
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

/// Options of figures that need a RUN of planes, with what has none.
void RefuseWithoutRun(const EvalOptions& options) {
  if (options.surfaces.file.empty() && !options.surfaces.camera.registration.empty()) {
    throw io::InputError("--depth-registration",
                         "is of --surfaces; name its file, or leave the option out");
  }
  if (!options.run.empty()) return;
  const std::pair<const char*, bool> of_runs[] = {
      {"--per-frame", !options.frames.empty()},
      {"--events", !options.events.empty()},
      {"--surfaces", !options.surfaces.file.empty()},
      {"--surface-pictures", !options.surfaces.pictures.empty()},
      {"--camera", !options.surfaces.camera.camera.empty()}};
  for (const auto& [name, given] : of_runs) {
    if (given) throw io::InputError(name, "is of a RUN folder; leave it out, or name the RUN");
  }
}

int Eval(const EvalOptions& options, const Globals& globals) {
  const bool files = !options.trajectory.files.empty(), labels = !options.segmentation.empty();
  if (int{files} + int{labels} + int{!options.run.empty()} != 1) {
    throw io::InputError("pas eval",
                         "expected one of a RUN folder, --trajectory FILE... and "
                         "--segmentation DIR; see pas eval --help");
  }
  RefuseWithoutRun(options);
  if (files) return EvalTrajectories(options, globals);
  return labels ? EvalLabels(options, globals) : EvalRun(options, globals);
}

void AddOtherInputs(CLI::App& command, EvalOptions& options) {
  CLI::Option* segmentation =
      command
          .add_option(
              "--segmentation", options.segmentation,
              "Folder of label images instead of a RUN: TIMESTAMP.png of 8 or 16 bits, a "
              "number for each plane of the frame, 0 for none; scored against gt/plane_id "
              "of the sequence of --truth")
          ->type_name("DIR");
  command
      .add_option("--per-frame", options.frames,
                  "File for a line of each frame: tracking, errors of the pose, planes, "
                  "decisions, time (docs/evaluation.md)")
      ->excludes(segmentation)
      ->type_name("FILE.csv");
  command
      .add_option(
          "--events", options.events,
          "File for all that went wrong, the most harmful first: wrong and missed "
          "associations, large surfaces without a decision, merges, splits, lost frames; "
          "JSON lines when it ends in .jsonl (docs/evaluation.md)")
      ->excludes(segmentation)
      ->type_name("FILE.csv");
}

}  // namespace

void PrintWarnings(const std::vector<eval::Fault>& faults,
                   const std::filesystem::path& folder) {
  for (const std::string& line : eval::Summaries(faults, folder)) PrintWarning(line);
}

void AddEvalCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  const auto options = std::make_shared<EvalOptions>();
  CLI::App* command = pas.add_subcommand(
      "eval",
      "Score a run against the truth: trajectory (metres, degrees), association of planes,\n"
      "planes and vertices of each frame, map (millimetres, degrees), time (milliseconds).\n"
      "A sequence without gt/ gives trajectory and time only; a run without segmentation/\n"
      "images (pas slam --save-segmentation) gives nothing that is counted by pixels.\n"
      "What cannot be scored is refused; what should be known beside the figures is a\n"
      "warning. With --trajectory, bare files of poses are scored, as evo does it; with\n"
      "--segmentation, label images. A run of another program needs no more than\n"
      "trajectory.txt, and --truth.\n"
      "Exit code 1 if the run tracked no frame.");
  command->add_option("RUN", options->run, "Run folder, as pas slam writes it");
  command->add_option(
      "--truth", options->truth,
      "Sequence folder with the truth (default: the one that RUN/run.json names, "
      "relative to RUN, to the folder above or to here, else where it was)");
  command->add_option("-o,--output", options->output,
                      "File to write, which must not exist (default: RUN/metrics.json, which "
                      "replaces an older one; with --trajectory or --segmentation none)");
  command->add_flag("--force", options->force, "Replace files that exist");
  AddSurfacesOption(*command, options->surfaces);
  AddOtherInputs(*command, *options);
  AddTrajectoryOptions(*command, options->trajectory);
  command->callback([options, &globals, &exit_code] { exit_code = Eval(*options, globals); });
}

}  // namespace app
