#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>

#include "app/app.h"
#include "app/eval/eval_modes.h"
#include "eval/plot/plotted_run.h"
#include "io/input_error.h"
#include "io/output_file.h"
#include "io/output_folder.h"

namespace app {
namespace {

namespace fs = std::filesystem;

struct PlotOptions {
  std::vector<std::string> runs, names;
  std::string output, truth;
  bool force = false;
};

constexpr const char* kCaptions = "captions.txt";  // which a folder of plots always has

/// A plot: how it is made, and what it shows, in words.
struct PlotKind {
  std::vector<eval::PlotFile> (*draw)(const std::vector<eval::PlottedRun>& runs);
  const char* name;
  const char* caption;
  const char* needs;
};
constexpr PlotKind kPlots[] = {
    {eval::PlotTrajectories, "trajectories",
     "Camera paths from above over the true ones, in the world of the truth, each aligned as "
     "for its ATE.",
     "poses with a truth"},
    {eval::PlotErrors, "position_error",
     "Position error after the alignment of the ATE over the time since the first pose, and "
     "the share of poses below each error.",
     "poses that can be aligned with the truth"},
    {eval::PlotSteps, "step_height",
     "Association on tops of regular objects over the height of their step: precision, of "
     "frame planes on them that were put on a map plane, the share on one of their own; "
     "recall, of tops in frames where they count, the share with such a frame plane.",
     "frame_planes.jsonl, and true planes"},
    {eval::PlotTimes, "module_times",
     "Mean time of each module a frame, with the 95th percentile.", "timing.csv"},
};

/// The last names of a path, `count` of them or all.
std::string LastNames(const fs::path& folder, int count) {
  fs::path names, above = folder;
  for (; count > 0 && above.has_filename(); --count, above = above.parent_path()) {
    names = names.empty() ? above.filename() : above.filename() / names;
  }
  return names.string();
}

/// The runs by the names of their folders, with as much of each path as tells it from the others.
std::vector<std::string> NamesOfFolders(const std::vector<std::string>& runs) {
  std::vector<fs::path> folders;
  for (const std::string& run : runs) {
    folders.push_back(fs::absolute(fs::path(run) / "").lexically_normal().parent_path());
    if (std::count(folders.begin(), folders.end(), folders.back()) == 1) continue;
    throw io::InputError(run,
                         "is given twice, and its curves could not be told apart; leave "
                         "one out, or name each run with --name");
  }
  std::vector<std::string> names;
  for (const fs::path& folder : folders) {
    int count = 1;
    const auto is_another = [&](const fs::path& other) {
      return other != folder && LastNames(other, count) == LastNames(folder, count);
    };
    while (std::any_of(folders.begin(), folders.end(), is_another)) ++count;
    names.push_back(LastNames(folder, count));
  }
  return names;
}

std::vector<eval::PlottedRun> Evaluated(const PlotOptions& options,
                                        const std::vector<std::string>& names) {
  std::vector<eval::PlottedRun> runs;
  for (std::size_t i = 0; i < options.runs.size(); ++i) {
    const eval::Run run = eval::ReadRun(options.runs[i]);
    const fs::path truth =
        options.truth.empty() ? eval::SequenceOf(run) : fs::path(options.truth);
    io::RefuseInputsInside(options.output, {truth});
    const eval::Sequence sequence = eval::ReadSequence(truth);
    runs.push_back({names[i], eval::Evaluate(run, sequence)});
    PrintWarnings(runs.back().evaluation.run_warnings, run.folder);
    PrintWarnings(runs.back().evaluation.sequence_warnings, sequence.folder);
  }
  return runs;
}

int RunPlot(const PlotOptions& options, const Globals& globals) {
  if (!options.names.empty() && options.names.size() != options.runs.size()) {
    throw io::InputError("--name",
                         fmt::format("is given {} times for {} runs; name all of them, "
                                     "in their order, or none",
                                     options.names.size(), options.runs.size()));
  }
  const std::set<std::string> names(options.names.begin(), options.names.end());
  if (names.size() != options.names.size()) {
    throw io::InputError("--name",
                         "gives two runs one name, by which their curves could not be told "
                         "apart; choose another for one");
  }
  const std::vector<std::string> run_names =
      options.names.empty() ? NamesOfFolders(options.runs) : options.names;
  io::RefuseInputsInside(options.output, {options.runs.begin(), options.runs.end()});
  io::OutputFolder folder(options.output, kCaptions, options.force);
  const std::vector<eval::PlottedRun> runs = Evaluated(options, run_names);
  std::string captions;
  for (const PlotKind& plot : kPlots) {
    const std::vector<eval::PlotFile> files = plot.draw(runs);
    for (const eval::PlotFile& file : files) folder.Write(file.name, file.bytes);
    captions += files.empty() ? fmt::format("no {}: no run has {}\n", plot.name, plot.needs)
                              : fmt::format("{}: {}\n", plot.name, plot.caption);
  }
  folder.Write(kCaptions, captions);
  folder.Commit();
  if (!globals.quiet) std::printf("%swrote %s\n", captions.c_str(), options.output.c_str());
  return kDone;
}

}  // namespace

void AddPlotCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  const auto options = std::make_shared<PlotOptions>();
  CLI::App* command = pas.add_subcommand(
      "plot",
      "Plots runs for a paper, as SVG, PDF and PNG: trajectories over the truth, position\n"
      "error over time and its distribution, precision and recall of the association over\n"
      "step height, times per module. Several runs stand in one plot, under their names.\n"
      "captions.txt says what each plot shows, and which ones there are not, and why.");
  command->add_option("RUN", options->runs, "Run folders")->required()->type_name("DIR...");
  command->add_option("-o,--output", options->output, "Folder for the plots")
      ->required()
      ->type_name("DIR");
  command
      ->add_option(
          "--name", options->names,
          "Name of a run, once for each in their order (default: names of the folders, with as "
          "much of the paths before them as tells them apart)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("TEXT");
  command
      ->add_option("--truth", options->truth,
                   "Sequence with the truth of all runs (default: those that the runs name)")
      ->type_name("SEQ");
  command->add_flag("--force", options->force, "Replace a folder of plots that exists");
  command->callback(
      [options, &globals, &exit_code] { exit_code = RunPlot(*options, globals); });
}

}  // namespace app
