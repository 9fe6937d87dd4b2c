#include "eval/formats/folder.h"

#include <fmt/format.h>

#include <cstdlib>

#include "io/path_type.h"

namespace eval {

std::string Describe(const Fault& fault) {
  std::string where = fault.file;
  if (fault.line > 0) where += fmt::format(":{}", fault.line);
  if (!fault.pointer.empty()) where += " " + fault.pointer;
  return fmt::format("{}: {}; {}", where, fault.what, fault.mend);
}

bool Folder::Has(const std::string& file) const { return io::Exists(root_ / file); }

bool Folder::Require(const std::string& file, const std::string& mend, Severity severity) {
  if (Has(file)) return true;
  Tell(file, 0, "is missing", mend, severity);
  return false;
}

std::filesystem::path Folder::Open(const std::string& file) {
  opened_.insert(file);
  return root_ / file;
}

void Folder::Tell(Fault fault, Severity severity) {
  if (on_fault_ == OnFault::kCollect) {
    faults_.push_back(std::move(fault));
  } else if (severity == Severity::kFatal) {
    fault.file = (root_ / fault.file).string();
    throw io::InputError(Describe(fault));
  }
}

void Folder::TellThrown(const std::string& file, std::string text, Severity severity) {
  const std::string place = (root_ / file).string() + ":";
  if (text.starts_with(place)) text = text.substr(place.size());
  const int line = std::atoi(text.c_str());
  const auto what = line > 0 ? text.find(": ") + 2 : text.find_first_not_of(' ');
  Tell(file, line, text.substr(what), "write it as the format says", severity);
}

}  // namespace eval
