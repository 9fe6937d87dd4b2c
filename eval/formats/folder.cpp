#include "eval/formats/folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "io/path_type.h"

namespace eval {

std::string Describe(const Fault& fault) {
  std::string where = fault.file;
  if (fault.line > 0) where += fmt::format(":{}", fault.line);
  if (!fault.pointer.empty()) where += " " + fault.pointer;
  return fmt::format("{}: {}; {}", where, fault.what, fault.mend);
}

std::vector<std::string> Summaries(const std::vector<Fault>& faults,
                                   const std::filesystem::path& place) {
  // What is there differs from line to line; how it is mended tells the kind.
  std::vector<std::pair<const Fault*, int>> kinds;
  for (const Fault& fault : faults) {
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const auto& other) {
      return other.first->file == fault.file && other.first->mend == fault.mend;
    });
    if (kind == kinds.end()) {
      kinds.emplace_back(&fault, 0);
    } else {
      ++kind->second;
    }
  }
  std::vector<std::string> lines;
  for (const auto& [first, more] : kinds) {
    Fault placed = *first;
    placed.file = (place / placed.file).string();
    lines.push_back(Describe(placed));
    if (more > 0) lines.back() += fmt::format(" (and {} more like it)", more);
  }
  return lines;
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
  fault.severity = severity;
  if (on_fault_ == OnFault::kCollect || severity == Severity::kWarning) {
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
