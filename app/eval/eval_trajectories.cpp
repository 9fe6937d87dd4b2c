#include <cstdio>
#include <filesystem>
#include <optional>

#include "app/eval/eval_modes.h"
#include "eval/report/trajectory_report.h"
#include "io/folder_kind.h"
#include "io/input_error.h"
#include "io/output_file.h"
#include "io/path_type.h"

namespace app {
namespace {

eval::PoseFile ReadWithWarnings(const std::string& file) {
  if (io::TypeAt(file) == std::filesystem::file_type::directory &&
      io::KindOf(file) == io::FolderKind::kSequence) {
    throw io::InputError(file, "is a sequence, expected a file of poses; name its " +
                                   (std::filesystem::path(file) / "groundtruth.txt").string());
  }
  eval::PoseFile poses = eval::ReadPoseFile(file);
  PrintWarnings(poses.warnings, poses.path.parent_path());
  return poses;
}

}  // namespace

int EvalTrajectories(const EvalOptions& options, const Globals& globals) {
  if (options.truth.empty()) {
    throw io::InputError("--trajectory", "needs a file of true poses; name it with --truth");
  }
  const eval::ComparisonRules rules = RulesOf(options.trajectory);
  std::optional<io::OutputFile> output;
  if (!options.output.empty()) {
    io::OutputRules refused{options.force, {options.truth}};
    refused.inputs.insert(refused.inputs.end(), options.trajectory.files.begin(),
                          options.trajectory.files.end());
    output.emplace(options.output, refused);
  }
  const eval::PoseFile truth = ReadWithWarnings(options.truth);
  std::vector<eval::ComparedTrajectory> compared;
  for (const std::string& file : options.trajectory.files) {
    const eval::PoseFile estimate = ReadWithWarnings(file);
    compared.push_back(
        {file, estimate.kind, eval::CompareTrajectories(estimate, truth, rules)});
  }
  if (output) {
    output->Write(eval::TrajectoriesJson(compared, options.truth, rules).dump(2) + "\n");
  }
  if (!globals.quiet) {
    std::fputs(eval::TrajectoriesTable(compared, options.truth, rules).c_str(), stdout);
    if (output) std::printf("wrote %s\n", options.output.c_str());
  }
  return kDone;
}

}  // namespace app
