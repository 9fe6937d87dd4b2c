#include "eval/check/check_run.h"

#include "eval/check/check_ply.h"
#include "eval/check/check_segmentation.h"
#include "eval/formats/run/run.h"

namespace eval {
CheckReport CheckRun(const std::filesystem::path& path) {
  Folder folder(path, OnFault::kCollect);
  const Run run = ReadRun(folder);
  CheckSegmentation(folder, run);
  CheckPly(folder, run);
  return {"run", std::move(folder.faults()), static_cast<int>(folder.opened().size()),
          run.info.frames.value_or(static_cast<int>(run.frames.size()))};
}

}  // namespace eval
