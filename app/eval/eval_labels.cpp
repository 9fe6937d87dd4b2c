#include <cstdio>
#include <optional>

#include "app/eval/eval_modes.h"
#include "eval/report/metrics_json.h"
#include "eval/report/table.h"
#include "io/input_error.h"
#include "io/output_file.h"

namespace app {

int EvalLabels(const EvalOptions& options, const Globals& globals) {
  if (options.truth.empty()) {
    throw io::InputError("--segmentation", "needs the sequence; name it with --truth");
  }
  std::optional<io::OutputFile> output;
  if (!options.output.empty()) {
    output.emplace(options.output,
                   io::OutputRules{options.force, {options.segmentation, options.truth}});
  }
  const eval::Run labels = eval::RunOfLabels(options.segmentation);
  const eval::Sequence sequence = eval::ReadSequence(options.truth);
  const eval::LabelEvaluation evaluation = eval::EvaluateLabels(labels, sequence);
  PrintWarnings(evaluation.label_warnings, labels.folder);
  PrintWarnings(evaluation.sequence_warnings, sequence.folder);
  if (output) output->Write(eval::LabelsJson(evaluation).dump(2) + "\n");
  if (!globals.quiet) {
    std::fputs(eval::LabelsTable(evaluation).c_str(), stdout);
    if (output) std::printf("wrote %s\n", options.output.c_str());
  }
  return kDone;
}

}  // namespace app
