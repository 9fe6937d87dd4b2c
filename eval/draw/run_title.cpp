#include "eval/draw/run_title.h"

#include <fmt/format.h>

namespace eval {
namespace {

std::string NameOfFolder(const std::filesystem::path& folder) {
  std::error_code error;
  const auto full = std::filesystem::absolute(folder / "", error).lexically_normal();
  return full.parent_path().filename().string();
}

}  // namespace

RunTitle TitleOf(const Run& run, const Sequence& sequence) {
  const int all = run.info.sequence_frames.value_or(static_cast<int>(sequence.frames.size()));
  const int seen = run.info.frames.value_or(all);
  RunTitle title{NameOfFolder(run.folder), NameOfFolder(sequence.folder), "", ""};
  title.figures = fmt::format("variant {}   tracked {} of {} frames",
                              run.info.variant.empty() ? "?" : run.info.variant,
                              run.trajectory.size(), seen);
  if (run.info.interrupted) {
    title.warning = fmt::format("interrupted after {} of {} frames", seen, all);
  }
  if (run.trajectory.empty()) {
    title.warning += std::string(title.warning.empty() ? "" : ", ") + "nothing was tracked";
  }
  return title;
}

}  // namespace eval
