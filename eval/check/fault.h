#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

/// Validation of sequence and run folders against the formats: every fault, not only the first.
namespace eval {

/// One thing that is wrong in a folder. A fault is a value: a folder that is all wrong is still
/// a normal result of a check.
struct Fault {
  std::string file;     ///< relative to the checked folder; "." is the folder itself
  int line = 0;         ///< from 1; 0 = the file as a whole, or a JSON document (see pointer)
  std::string pointer;  ///< JSON pointer within the line or the document; may be empty
  std::string what;     ///< what is there and what was expected
  std::string mend;     ///< what to do about it
};

/// "rgb.txt:12: what: mend", with the JSON pointer behind the line where there is one.
std::string Describe(const Fault& fault);

/// What the checks of one folder share: where it is and what they found.
struct FolderCheck {
  std::filesystem::path root;
  std::vector<Fault> faults;
  std::set<std::string> files;  ///< every file that was opened, relative to root

  std::set<std::string> broken;  ///< images of them that are no use to later checks

  void Add(std::string file, int line, std::string what, std::string mend);
  /// True when the file exists; else a fault says that it is missing.
  bool Require(const std::string& file, const std::string& mend);
  bool Has(const std::string& file) const;
};

/// The outcome of a check.
struct CheckReport {
  std::string kind;  ///< "sequence" or "run"
  std::vector<Fault> faults;
  int files = 0;
  int frames = 0;
};

}  // namespace eval
