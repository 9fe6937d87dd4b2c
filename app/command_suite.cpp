#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/app.h"
#include "app/suite/results.h"
#include "app/suite/suite_call.h"
#include "io/folder_lock.h"
#include "io/input_error.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAboutSuite =
    "Run every scene of a suite with every sensor, motion, seed, variant and config, each\n"
    "case in processes of its own with limits of time and memory, and put the figures into\n"
    "DIR/results.sqlite. A crash, a time-out or want of memory is a row. Called again it runs\n"
    "what is not there yet, or whose inputs or program have changed. With --baseline it says\n"
    "what became worse (docs/suites.md). Exit code 1 if something became worse or cannot be\n"
    "told; without a baseline, if a case failed or is beyond a bound of the suite.";

int Merge(const std::vector<std::string>& folders, const fs::path& output, bool quiet) {
  RequireResultsFolder(output);
  for (const std::string& folder : folders) {
    RequireResults(folder);
    std::error_code ignored;
    if (fs::equivalent(folder, output, ignored)) {
      throw io::InputError(folder, "is the output too; name another with -o");
    }
  }
  const io::FolderLock lock(output);
  Results results(output);
  for (const std::string& folder : folders) results.Merge(folder);
  if (!quiet) fmt::print("{}: {} cases\n", output.string(), results.Rows().size());
  return kDone;
}

CLI::App* AddMerge(CLI::App& suite, const Globals& globals, int& exit_code) {
  struct MergeArguments {
    std::vector<std::string> folders;
    std::string output;
  };
  const auto arguments = std::make_shared<MergeArguments>();
  CLI::App* merge = suite.add_subcommand(
      "merge", "Put the results of several folders, shards of one suite, into one");
  merge->add_option("DIR", arguments->folders, "Folders of results")->required();
  merge->add_option("-o,--output", arguments->output, "Folder to write or to add to")
      ->required();
  merge->callback([arguments, &globals, &exit_code] {
    exit_code = Merge(arguments->folders, arguments->output, globals.quiet);
  });
  return merge;
}

}  // namespace

void AddSuiteCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* command = pas.add_subcommand("suite", kAboutSuite);
  const auto arguments = std::make_shared<SuiteArguments>();
  command->add_option("SUITE", arguments->suite, "Suite file (YAML)");
  command->add_option("-o,--output", arguments->output,
                      "Folder of the results; new, empty, or of an earlier call");
  command
      ->add_option("-j,--jobs", arguments->jobs,
                   "Cases at a time; 0: one a core. Rows do not depend on it, but for times")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->add_flag(
      "--retry-failed", arguments->retry_failed,
      "Run cases again that failed, crashed or ran into a limit: a full disk, say, or a "
      "machine without memory");
  command->add_option("--recordings", arguments->recordings,
                      "Folder of recordings, for suites that run on them");
  command->add_option("--program", arguments->program,
                      "Program that runs the cases instead of this one: another build of pas");
  CLI::Option* shard = command->add_option(
      "--shard", arguments->shard, "I/N: only every Nth case from the Ith on; see merge");
  CLI::Option* baseline =
      command->add_option("--baseline", arguments->baseline,
                          "File to compare with, seed by seed; more seeds are run up to the "
                          "suite's most while it cannot be told whether something is worse");
  CLI::Option* accept =
      command
          ->add_option("--accept", arguments->accept,
                       "REASON: run all seeds and write --baseline anew, with this reason in "
                       "it")
          ->needs(baseline);
  CLI::Option* replay = command->add_option(
      "--replay", arguments->replay,
      "CASE: run this one again in DIR/replay, without limits, and say how");
  CLI::Option* shrink = command->add_option(
      "--shrink", arguments->shrink,
      "CASE: look for a smaller case that fails as this one does, or is as much worse than in "
      "--baseline, with fewer frames and objects and smaller images; written to DIR/shrunk");
  shrink->excludes(accept)->excludes(shard)->excludes(replay);
  shard->excludes(baseline)->excludes(replay);
  replay->excludes(baseline);

  const CLI::App* merge = AddMerge(*command, globals, exit_code);
  command->callback([merge, arguments, &globals, &exit_code] {
    if (merge->parsed()) return;
    if (arguments->suite.empty() || arguments->output.empty()) {
      throw io::InputError(
          "pas suite",
          "needs SUITE.yaml and -o DIR, or merge DIR... -o DIR; see pas suite --help");
    }
    exit_code = CallSuite(*arguments, globals.quiet);
  });
}

}  // namespace app
