#include "eval/check/check_folder.h"

#include "eval/check/check_run.h"
#include "eval/check/check_sequence.h"
#include "io/folder_kind.h"

namespace eval {

CheckReport CheckFolder(const std::filesystem::path& folder, bool deep) {
  const io::FolderKind kind = io::KindOf(folder);
  if (kind == io::FolderKind::kRun) return CheckRun(folder);
  if (kind == io::FolderKind::kSequence) return CheckSequence(folder, deep);
  const io::WrongFolder wrong = io::Unexpected(folder, kind, io::FolderKind::kOther);
  return {"folder", {{folder.string(), 0, "", wrong.what, wrong.mend}}, 0, 0};
}

}  // namespace eval
