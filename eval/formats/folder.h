#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "io/input_error.h"

/// The files of a sequence or a run: one reader for each, which gives its value and tells what
/// is wrong with it.
namespace eval {

/// What a fault does to figures and pictures that rest on the file, the gravest first. docs/faults.md
/// lists which fault is which.
enum class Severity {
  kFatal,    ///< they would be wrong, or there are none
  kWarning,  ///< they can be made, but who looks at them should know
  kFlaw,     ///< nothing: the format asks for something else, and only a check tells so
};

/// One thing that is wrong in a folder. To a check it is a value: a folder that is all wrong is
/// still a normal result.
struct Fault {
  std::string file;     ///< relative to the folder; "." is the folder itself
  int line = 0;         ///< from 1; 0 = the file as a whole, or a JSON document (see pointer)
  std::string pointer;  ///< JSON pointer within the line or the document; may be empty
  std::string what;     ///< what is there and what was expected
  std::string mend;     ///< what to do about it
  Severity severity = Severity::kFatal;
};

/// "rgb.txt:12: what; mend", with the JSON pointer behind the line where there is one.
std::string Describe(const Fault& fault);

/// What becomes of faults.
enum class OnFault {
  kThrow,  ///< the first fatal one is thrown as an InputError, warnings are kept, flaws are not
  kCollect  ///< all are kept; a reader leaves out what is at fault, and goes on
};

/// A line for each kind of fault, the first of the kind standing for the rest:
/// "RUN/frame_planes.jsonl:12 /planes/3/d: is -1; turn it around (and 11 more like it)".
/// @param place  goes before the file
std::vector<std::string> Summaries(const std::vector<Fault>& faults,
                                   const std::filesystem::path& place);

/// A folder that is read, and what is wrong in it.
class Folder {
 public:
  explicit Folder(std::filesystem::path root, OnFault on_fault = OnFault::kThrow)
      : root_(std::move(root)), on_fault_(on_fault) {}

  const std::filesystem::path& root() const { return root_; }
  bool Has(const std::string& file) const;
  /// True when the file exists; else a fault says that it is missing.
  bool Require(const std::string& file, const std::string& mend,
               Severity severity = Severity::kFatal);

  /// @throws InputError for a fatal fault, unless faults are collected
  void Tell(Fault fault, Severity severity = Severity::kFatal);
  void Tell(std::string file, int line, std::string what, std::string mend,
            Severity severity = Severity::kFatal) {
    Tell({std::move(file), line, "", std::move(what), std::move(mend)}, severity);
  }
  /// Calls `read`, which may throw an InputError ("camera.yaml:8: fps: expected ..."): that is
  /// a fault of the file. @returns whether it threw nothing
  template <typename Read>
  bool Try(const std::string& file, const Read& read, Severity severity = Severity::kFatal) {
    try {
      read();
      return true;
    } catch (const io::InputError& error) {
      if (on_fault_ == OnFault::kThrow && severity == Severity::kFatal) throw;
      TellThrown(file, error.what(), severity);
      return false;
    }
  }
  /// Notes that a file was opened. @returns its path
  std::filesystem::path Open(const std::string& file);

  std::vector<Fault>& faults() { return faults_; }  ///< those that are kept
  const std::set<std::string>& opened() const { return opened_; }

 private:
  void TellThrown(const std::string& file, std::string text, Severity severity);

  std::filesystem::path root_;
  OnFault on_fault_;
  std::vector<Fault> faults_;
  std::set<std::string> opened_;  ///< relative to the folder
};

}  // namespace eval
