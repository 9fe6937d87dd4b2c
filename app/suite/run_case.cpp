#include "app/suite/run_case.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/suite/child_process.h"
#include "eval/formats/run/timing.h"
#include "eval/regression/time_ratios.h"
#include "io/input_error.h"
#include "io/json_field.h"
#include "io/output_folder.h"
#include "io/sha256.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOutOfMemory = "out of memory";  // as console/failure.cpp says it
constexpr const char* kTiming = "timing.csv";
constexpr const char* kTimesGroup = "/timing_ms/";

bool IsOutOfMemory(const ChildOutcome& outcome) {
  for (const char* words : {kOutOfMemory, "bad_alloc", "Cannot allocate memory"}) {
    if (outcome.errors.find(words) != std::string::npos) return true;
  }
  // Nobody here killed it, so it was the system, which does that when memory is short.
  return outcome.end == ChildOutcome::End::kSignalled && outcome.code == SIGKILL;
}

/// The last line that says something; the last of the program's own when there is one.
std::string LastLine(const std::string& errors) {
  std::istringstream lines(errors);
  std::string last, line;
  bool own = false;
  while (std::getline(lines, line)) {
    const bool is_own = line.rfind("pas: ", 0) == 0 && line.rfind("pas: warning", 0) != 0;
    if (line.empty() || (own && !is_own)) continue;
    own = own || is_own;
    last = line;
  }
  return last;
}

/// Whoever ends it by such a signal, a scheduler or a person, means the suite, which may be told a moment later.
bool WasAskedToEnd(const ChildOutcome& outcome) {
  constexpr int kBySignal = 128;  // as shells and `pas slam` say it
  using End = ChildOutcome::End;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (outcome.end == End::kSignalled && outcome.code == signal) return true;
    if (outcome.end == End::kExited && outcome.code == kBySignal + signal) return true;
  }
  return false;
}

CaseStatus StatusOf(const ChildOutcome& outcome) {
  using End = ChildOutcome::End;
  if (outcome.end == End::kStopped || WasAskedToEnd(outcome)) return CaseStatus::kStopped;
  if (outcome.end == End::kTimedOut) return CaseStatus::kTimedOut;
  if (outcome.end == End::kExited && outcome.code == 0) return CaseStatus::kFinished;
  if (IsOutOfMemory(outcome)) return CaseStatus::kOutOfMemory;
  return outcome.end == End::kSignalled ? CaseStatus::kCrashed : CaseStatus::kFailed;
}

std::string MessageOf(const ChildOutcome& outcome, const SuiteLimits& limits) {
  const CaseStatus status = StatusOf(outcome);
  switch (status) {
    case CaseStatus::kFinished:
    case CaseStatus::kStopped:
      return "";
    case CaseStatus::kTimedOut:
    case CaseStatus::kOutOfMemory:
      return LimitMessage(status, limits);
    case CaseStatus::kCrashed:
      return std::string("ended by ") + ::strsignal(outcome.code);
    case CaseStatus::kFailed:
      break;
  }
  const std::string line = LastLine(outcome.errors);
  return "exit code " + std::to_string(outcome.code) + (line.empty() ? "" : ": " + line);
}

/// Numbers and nulls of metrics.json; those of times apart.
void ReadMetrics(const fs::path& file, CaseResult& result) {
  const nlohmann::json metrics = io::ReadJson(file).flatten();
  for (const auto& [pointer, value] : metrics.items()) {
    const bool is_text = pointer.rfind("/reasons", 0) == 0 || pointer.rfind("/rules", 0) == 0 ||
                         pointer.rfind("/warnings", 0) == 0;  // empty ones come as null
    if (is_text || (!value.is_number() && !value.is_null())) continue;
    const auto number = value.is_null() ? std::nullopt : std::optional(value.get<double>());
    (pointer.rfind(kTimesGroup, 0) == 0 ? result.times : result.figures)[pointer] = number;
  }
}

/// Times of the modules as the gate compares them; none without a timing.csv.
eval::Figures TimeRatiosOf(const fs::path& run) {
  if (!fs::exists(run / kTiming)) return {};
  eval::Folder folder(run);
  return eval::TimeRatios(eval::ReadTiming(folder, kTiming));
}

/// The work folder of a case, gone with the object.
class WorkFolder {
 public:
  WorkFolder(const fs::path& results, const std::string& key)
      : relative_(fs::path("work") / io::Sha256Hex(key).substr(0, kHashDigits)),
        whole_(results / relative_) {
    fs::remove_all(whole_);  // of a suite that was killed
    io::MakeFolder(whole_);
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(whole_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const fs::path& relative() const { return relative_; }
  const fs::path& whole() const { return whole_; }

 private:
  static constexpr std::size_t kHashDigits = 16;  // two of a million cases meet 1 in 10^7 times
  fs::path relative_, whole_;
};

/// Seconds that the estimator took: the mean of the whole tracking times the frames.
double SlamSeconds(const CaseResult& result) {
  const auto value = [](const eval::Figures& figures, const char* name) {
    const auto found = figures.find(name);
    return found == figures.end() ? 0.0 : found->second.value_or(0.0);
  };
  return 1e-3 * value(result.times, "/timing_ms/mt/mean") *
         value(result.figures, eval::kFramesFigure);
}

/// As a shell reads it back: in quotes unless every character stands for itself.
std::string ShellWord(const std::string& text) {
  const bool plain =
      !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || std::strchr("_-+./,:=@%", c) != nullptr;
      });
  if (plain) return text;
  std::string word(1, '\'');
  for (const char c : text) {
    word.push_back(c);
    if (c == '\'') word.append("\\''");  // out of the quotes, one by itself, and in again
  }
  word.push_back('\'');
  return word;
}

}  // namespace

const char* NameOf(CaseStatus status) {
  constexpr std::array kNames{"done", "failed", "crashed", "timeout", "memory", "stopped"};
  return kNames[static_cast<std::size_t>(status)];
}

std::string LimitMessage(CaseStatus status, const SuiteLimits& limits) {
  std::ostringstream text;
  if (status == CaseStatus::kTimedOut) {
    text << "not done after " << limits.seconds << " s";
  } else {
    text << "needs more than " << limits.memory_mb << " MiB";
  }
  return text.str();
}

std::vector<std::vector<std::string>> CommandsOf(const SuiteCase& one,
                                                 const std::string& program,
                                                 const std::string& run) {
  std::vector<std::string> slam{program, "-q", "slam"};
  slam.insert(slam.end(), one.slam.begin(), one.slam.end());
  slam.insert(slam.end(), {"-o", run, "--force"});
  return {slam, {program, "-q", "eval", run}};
}

std::string CommandLines(const std::vector<std::vector<std::string>>& commands) {
  std::string lines;
  for (const std::vector<std::string>& command : commands) {
    if (!lines.empty()) lines += " && ";
    for (std::size_t i = 0; i < command.size(); ++i) {
      if (i > 0) lines += ' ';
      lines += ShellWord(command[i]);
    }
  }
  return lines;
}

CaseResult RunCase(const SuiteCase& one, const SuiteProgram& program, const SuiteLimits& limits,
                   const fs::path& folder, const std::function<bool()>& stop) {
  const WorkFolder work(folder, one.key);
  const std::string run = (work.relative() / "run").string();
  CaseResult result;
  std::vector<double> seconds;
  double peak_mb = 0.0;
  for (const std::vector<std::string>& command : CommandsOf(one, program.run.string(), run)) {
    const ChildOutcome outcome =
        RunChild(command, folder, work.whole() / "errors", limits, stop);
    seconds.push_back(outcome.seconds);
    peak_mb = std::max(peak_mb, outcome.peak_mb);
    result.status = StatusOf(outcome);
    result.message = MessageOf(outcome, limits);
    // The folder's name says nothing, and paths differ from machine to machine.
    for (std::size_t at; (at = result.message.find(run)) != std::string::npos;) {
      result.message.replace(at, run.size(), "RUN");
    }
    if (result.status != CaseStatus::kFinished) break;
  }
  if (result.status == CaseStatus::kFinished) {
    const fs::path metrics = work.whole() / "run" / "metrics.json";
    if (!fs::exists(metrics)) {
      throw io::InputError(program.file.string(),
                           "ended without an error, but wrote no metrics.json of a case; is "
                           "this --program a build of pas?");
    }
    ReadMetrics(metrics, result);
    result.times.merge(TimeRatiosOf(work.whole() / "run"));
    result.times[kSlamTime] = SlamSeconds(result);
    result.times[kRenderingTime] = std::max(0.0, seconds.front() - SlamSeconds(result));
    result.times[kEvaluationTime] = seconds.back();
  }
  result.times[kPeakMemory] = peak_mb;
  return result;
}

}  // namespace app
