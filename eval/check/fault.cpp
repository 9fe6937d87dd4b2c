#include "eval/check/fault.h"

#include <fmt/format.h>

namespace eval {

std::string Describe(const Fault& fault) {
  std::string where = fault.file;
  if (fault.line > 0) where += fmt::format(":{}", fault.line);
  if (!fault.pointer.empty()) where += " " + fault.pointer;
  return fmt::format("{}: {}; {}", where, fault.what, fault.mend);
}

void FolderCheck::Add(std::string file, int line, std::string what, std::string mend) {
  faults.push_back({std::move(file), line, "", std::move(what), std::move(mend)});
}

bool FolderCheck::Require(const std::string& file, const std::string& mend) {
  if (Has(file)) return true;
  Add(file, 0, "is missing", mend);
  return false;
}

bool FolderCheck::Has(const std::string& file) const {
  std::error_code ignored;
  return std::filesystem::exists(root / file, ignored);
}

}  // namespace eval
