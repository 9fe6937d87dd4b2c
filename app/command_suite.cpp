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
    "Run every scene of a suite with every sensor, motion, seed, variant and config, each "
    "case\n"
    "in processes of its own with limits of time and memory, and put the figures into\n"
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

}  // namespace

void AddSuiteCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* command = pas.add_subcommand("suite", kAboutSuite);
  const auto arguments = std::make_shared<SuiteArguments>();
  command->add_option("SUITE", arguments->suite, "Suite file (YAML)");
  command->add_option("-o,--output", arguments->output,
                      "Folder of the results; new, empty, or of an earlier call");
  command
      ->add_option("-j,--jobs", arguments->jobs,
                   "Cases at a time; 0: one a core. Rows do not "
                   "depend on it, but for times")
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
  command
      ->add_option("--accept", arguments->accept,
                   "REASON: run all seeds and write --baseline anew, with this reason in it")
      ->needs(baseline);
  CLI::Option* replay = command->add_option(
      "--replay", arguments->replay,
      "CASE: run this one again in DIR/replay, without limits, and say how");
  CLI::Option* shrink = command->add_option("--shrink", arguments->shrink,
                                            "CASE: look for a smaller case that fails as this "
                                            "one does, with fewer frames and objects "
                                            "and smaller images; written to DIR/shrunk");
  shrink->excludes(baseline)->excludes(shard)->excludes(replay);
  shard->excludes(baseline)->excludes(replay);
  replay->excludes(baseline);

  struct MergeArguments {
    std::vector<std::string> folders;
    std::string output;
  };
  const auto merged = std::make_shared<MergeArguments>();
  CLI::App* merge = command->add_subcommand(
      "merge", "Put the results of several folders, shards of one suite, into one");
  merge->add_option("DIR", merged->folders, "Folders of results")->required();
  merge->add_option("-o,--output", merged->output, "Folder to write or to add to")->required();
  command->callback([merge, merged, arguments, &globals, &exit_code] {
    if (merge->parsed()) {
      exit_code = Merge(merged->folders, merged->output, globals.quiet);
      return;
    }
    if (arguments->suite.empty() || arguments->output.empty()) {
      throw io::InputError(
          "pas suite",
          "needs SUITE.yaml and -o DIR, or merge DIR... -o DIR; see pas suite --help");
    }
    exit_code = CallSuite(*arguments, globals.quiet);
  });
}

}  // namespace app
