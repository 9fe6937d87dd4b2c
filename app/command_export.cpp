#include <cstdio>

#include "app/app.h"
#include "app/console/console.h"
#include "app/options/choice_option.h"
#include "eval/export/bop.h"
#include "eval/export/coco.h"
#include "io/output_file.h"
#include "version.h"

namespace app {
namespace {

constexpr const char* kAboutExport =
    "Write sequences with truth in a format that detectors and pose estimators are trained\n"
    "on.\n"
    "  coco  instances of all objects with exact masks (annotations/instances.json, images/)\n"
    "  bop   poses, silhouettes and visible masks of the boxes, one scene a sequence\n"
    "Several sequences become one data set. docs/export.md says what each file holds.\n"
    "Masks, boxes and poses are of one instant: record what is to be trained on with\n"
    "--rolling-ms 0.";

enum class Format { kCoco, kBop };

struct ExportArguments {
  std::vector<std::string> sequences;
  std::string output;
  Format format = Format::kCoco;
  eval::ExportOptions options;
};

int RunExport(ExportArguments arguments, bool quiet) {
  std::unique_ptr<Progress> progress;
  arguments.options.version = PAS_VERSION;
  arguments.options.warn = PrintWarning;
  arguments.options.progress = [&](int done, int total) {
    if (!progress) progress = std::make_unique<Progress>("export", total, quiet);
    progress->Update(done);
  };
  const std::vector<std::filesystem::path> folders(arguments.sequences.begin(),
                                                   arguments.sequences.end());
  if (arguments.options.force) io::RefuseInputsInside(arguments.output, folders);
  const bool coco = arguments.format == Format::kCoco;
  const eval::ExportSummary summary =
      coco ? eval::ExportCoco(folders, arguments.output, arguments.options)
           : eval::ExportBop(folders, arguments.output, arguments.options);
  progress.reset();
  if (!quiet) {
    std::printf("%s: %d images, %d instances of %d %s\n", arguments.output.c_str(),
                summary.images, summary.instances, summary.kinds,
                coco ? "categories" : "models");
    if (summary.left_out > 0) {
      std::printf(
          "%d objects are no boxes; the truth does not hold their shape, so they have "
          "no model and no annotation\n",
          summary.left_out);
    }
  }
  return kDone;
}

}  // namespace

void AddExportCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* command = pas.add_subcommand("export", kAboutExport);
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("SEQ", arguments->sequences, "Sequence folders with truth")->required();
  command->add_option("--format", arguments->format, "coco | bop")
      ->required()
      ->transform(ChoiceOf<Format>({{"coco", Format::kCoco}, {"bop", Format::kBop}}));
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder to write; it is there whole or not at all")
      ->required();
  command->add_flag("--structure", arguments->options.structure,
                    "Also desk, floor, walls and the like");
  command->add_flag("--force", arguments->options.force, "Replace an older export");
  command->callback(
      [arguments, &globals, &exit_code] { exit_code = RunExport(*arguments, globals.quiet); });
}

}  // namespace app
