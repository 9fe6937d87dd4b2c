#include "app/suite/suite_call.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <optional>
#include <set>
#include <thread>

#include "app/app.h"
#include "app/console/console.h"
#include "app/console/stop_signal.h"
#include "app/suite/repeated_times.h"
#include "app/suite/replay_case.h"
#include "app/suite/results.h"
#include "app/suite/run_suite.h"
#include "app/suite/shrink_case.h"
#include "app/suite/suite_gate.h"
#include "app/suite/summary.h"
#include "eval/regression/history.h"
#include "io/folder_lock.h"
#include "io/input_error.h"
#include "io/number_text.h"
#include "io/output_file.h"
#include "io/output_folder.h"
#include "version.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr double kMostShards = 1e9;  // more than any suite has cases; a count holds it

/// "I/N", or nothing for all cases.
SuiteShard ShardOf(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t slash = text.find('/');
  const auto i = io::ParseNumber(text.substr(0, slash));
  const auto n = io::ParseNumber(slash == std::string::npos ? "" : text.substr(slash + 1));
  if (!i || !n || *i != std::floor(*i) || *n != std::floor(*n) || *i < 1 || *i > *n ||
      *n > kMostShards) {
    throw io::InputError("--shard " + text,
                         "expected I/N with I from 1 to N and N up to 1e9, such as 1/4");
  }
  return {static_cast<std::size_t>(*i) - 1, static_cast<std::size_t>(*n)};
}

/// One call of `pas suite` on a suite file.
class SuiteCall {
 public:
  SuiteCall(const SuiteArguments& arguments, bool quiet)
      : arguments_(arguments),
        quiet_(quiet),
        suite_(ReadSuite(arguments.suite)),
        program_(ProgramOf(arguments.program)),
        shard_(ShardOf(arguments.shard)),
        folder_(fs::absolute(arguments.output)) {}

  int Run() {
    RequireResultsFolder(folder_);
    std::optional<eval::Baseline> baseline;
    const bool accepting = !arguments_.accept.empty();
    if (!arguments_.baseline.empty()) baseline = accepting ? Replaced() : ReadTheBaseline();
    const io::FolderLock lock(folder_);
    Results results(folder_);
    int seeds = accepting ? suite_.seeds.max_count : suite_.seeds.count;
    std::vector<SuiteCase> cases = Plan(seeds, shard_);
    if (!arguments_.replay.empty()) {
      return ReplayCase(Named(arguments_.replay), program_, folder_, quiet_);
    }
    if (!arguments_.shrink.empty()) return Shrink(baseline);
    std::optional<io::OutputFile> accepted;  // refused before the work
    if (accepting) {
      accepted.emplace(arguments_.baseline,
                       io::OutputRules{.force = true, .inputs = {arguments_.suite}});
    }
    if (baseline && !accepting) RequireSameInputs(*baseline, cases);
    if (!RunAll(cases, results, arguments_.retry_failed)) return Interrupted();

    if (accepting) return Accept(cases, results, baseline, *accepted);
    if (!baseline) {
      const int done = Summarise(cases, results);
      return WithinBounds(cases, results) ? done : kFailure;
    }
    // As long as it cannot be told, more seeds of the arms in question.
    eval::GateReport report = Compare(*baseline, cases, results.Rows());
    while (!report.AnyWorseButTimes() && !report.UndecidedArms().empty() &&
           seeds < suite_.seeds.max_count) {
      seeds = std::min(2 * seeds, suite_.seeds.max_count);
      if (!quiet_) fmt::print("not decided yet: {} seeds\n", seeds);
      const std::vector<SuiteCase> more = CasesOf(Plan(seeds), report.UndecidedArms());
      if (!RunAll(more, results)) return Interrupted();
      Join(more, cases);
      report = Compare(*baseline, cases, results.Rows());
    }
    // A time that may be worse is measured again: one run strays, or the machine had other work.
    if (const auto arms = report.ArmsWithDoubtfulTimes(); !arms.empty()) {
      const auto rows = TimedAgain(CasesOf(cases, arms), results);
      if (!rows) return Interrupted();
      report = Compare(*baseline, cases, *rows);
    }
    Summarise(cases, results);
    return Verdict(report, OthersFailed(cases, results.Rows()));
  }

 private:
  std::vector<SuiteCase> Plan(int seeds, const SuiteShard& shard = {}) const {
    return PlanCases(suite_, seeds, arguments_.recordings, program_, folder_, shard);
  }

  SuiteRunOptions RunOptions() const {
    SuiteRunOptions options{.folder = folder_,
                            .program = program_,
                            .version = PAS_VERSION,
                            .limits = suite_.limits,
                            .jobs = arguments_.jobs,
                            .quiet = quiet_,
                            .retry_failed = false,
                            .stop = {}};
    if (options.jobs == 0) {
      options.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    }
    options.stop = [] { return StopSignal::Caught() != 0; };
    return options;
  }

  /// @returns false when it was interrupted
  bool RunAll(const std::vector<SuiteCase>& cases, Results& results, bool retry = false) const {
    const StopSignal stop;
    SuiteRunOptions options = RunOptions();
    options.retry_failed = retry;
    caught_ = RunCases(cases, options, results) ? Caught() : 0;
    return caught_ == 0;
  }

  /// @returns rows with the medians of more runs of these cases; nothing when it was interrupted
  std::optional<std::map<std::string, ResultRow>> TimedAgain(
      const std::vector<SuiteCase>& cases, Results& results) const {
    const StopSignal stop;
    if (!quiet_) fmt::print("times are measured again\n");
    auto rows = MeasureTimesAgain(cases, RunOptions(), results.Rows());
    caught_ = rows ? 0 : Caught();
    return rows;
  }

  /// The signal that ended the cases; that of a case which was ended by itself is not known here.
  static int Caught() { return StopSignal::Caught() != 0 ? StopSignal::Caught() : SIGTERM; }

  int Interrupted() const {
    PrintAside(
        fmt::format("pas: interrupted; {} keeps what was done, and the same call goes on\n",
                    folder_.string()));
    return ExitCodeOf(caught_);
  }

  eval::Baseline ReadTheBaseline() const {
    eval::Baseline baseline = eval::ReadBaseline(arguments_.baseline);
    if (baseline.suite != suite_.name || baseline.plan != PlanText(suite_)) {
      throw io::InputError(arguments_.baseline,
                           "is of the suite " + baseline.suite + " with " + baseline.plan +
                               ", but " + arguments_.suite + " is " + suite_.name + " with " +
                               PlanText(suite_) + "; write a new one with --accept");
    }
    return baseline;
  }

  /// The baseline whose place a new one is to take, for its history, which begins anew where there
  /// is none, or one of another plan.
  std::optional<eval::Baseline> Replaced() const {
    if (!fs::exists(arguments_.baseline)) return std::nullopt;
    eval::Baseline before = eval::ReadBaseline(arguments_.baseline);
    if (before.suite == suite_.name && before.plan == PlanText(suite_)) return before;
    PrintWarning(arguments_.baseline + " is of the suite " + before.suite + " with " +
                 before.plan + ": the history of the new one begins with it");
    return std::nullopt;
  }

  /// What was accepted is compared with cases of the same scenes, sensors and settings alone; cases that
  /// the suite has lost are told.
  void RequireSameInputs(const eval::Baseline& baseline,
                         const std::vector<SuiteCase>& cases) const {
    std::vector<std::string> other, lost;
    for (const SuiteCase& one : cases) {
      const auto before = baseline.cases.find(one.key);
      if (before != baseline.cases.end() && before->second.inputs != one.setup_sha256)
        other.push_back(one.key);
    }
    if (!other.empty()) {
      throw io::InputError(
          arguments_.baseline,
          fmt::format(
              "{} of its {} cases are of other scenes, sensors or settings than those of {}, "
              "such as {}; write a new one with --accept",
              other.size(), baseline.cases.size(), arguments_.suite, other.front()));
    }
    const std::vector<std::string> keys =
        CaseKeys(suite_, suite_.seeds.max_count, arguments_.recordings, folder_);
    for (const auto& [key, one] : baseline.cases) {
      if (!std::binary_search(keys.begin(), keys.end(), key)) lost.push_back(key);
    }
    if (lost.empty()) return;
    PrintWarning(fmt::format(
        "{} of {} cases of {} are none of {}, such as {}: nothing says how they are",
        lost.size(), baseline.cases.size(), arguments_.baseline, arguments_.suite,
        lost.front()));
  }

  /// Cases that are others now, though named alike, say nothing of the step.
  std::vector<eval::PastBaseline> HistoryAfter(eval::Baseline before,
                                               const eval::GateCases& now) const {
    std::erase_if(before.cases, [&](const auto& one) {
      const auto found = now.find(one.first);
      return found != now.end() && found->second.inputs != one.second.inputs;
    });
    eval::GateRules rules = suite_.gate;
    rules.looks = LooksOf(suite_.seeds);
    rules.times = false;
    return eval::HistoryAfter(before, eval::CompareWithBaseline(before, now, rules));
  }

  int Accept(const std::vector<SuiteCase>& cases, Results& results,
             const std::optional<eval::Baseline>& before, const io::OutputFile& file) const {
    const auto rows = suite_.gate.times ? TimedAgain(cases, results) : results.Rows();
    if (!rows) return Interrupted();
    eval::Baseline baseline{suite_.name,       PlanText(suite_),
                            PAS_VERSION,       ProcessorName(),
                            arguments_.accept, GatedCases(suite_, cases, *rows)};
    if (before) baseline.history = HistoryAfter(*before, baseline.cases);
    file.Write(eval::BaselineText(baseline));
    const int done = Summarise(cases, results);
    if (!quiet_) fmt::print("wrote {}\n", arguments_.baseline);
    if (done != kDone) PrintWarning(arguments_.baseline + " holds cases that failed as failed");
    return done;
  }

  eval::GateReport Compare(const eval::Baseline& baseline, const std::vector<SuiteCase>& cases,
                           const std::map<std::string, ResultRow>& rows) const {
    eval::GateRules rules = suite_.gate;
    rules.looks = LooksOf(suite_.seeds);
    rules.times = rules.times && IsSameProcessor(baseline.processor, ProcessorName());
    if (suite_.gate.times && !rules.times && !quiet_) {
      PrintWarning("times are not compared: the baseline's processor is " + baseline.processor +
                   ", this one is " + ProcessorName());
    }
    return eval::CompareWithBaseline(baseline, GatedCases(suite_, cases, rows), rules);
  }

  static std::vector<SuiteCase> CasesOf(const std::vector<SuiteCase>& cases,
                                        const std::vector<std::string>& arms) {
    const std::set<std::string> wanted(arms.begin(), arms.end());
    std::vector<SuiteCase> found;
    for (const SuiteCase& one : cases) {
      if (wanted.count(eval::ArmOfKey(one.key)) > 0) found.push_back(one);
    }
    return found;
  }

  /// Adds those of `more` that are not among the cases yet.
  static void Join(const std::vector<SuiteCase>& more, std::vector<SuiteCase>& cases) {
    std::set<std::string> known;
    for (const SuiteCase& one : cases) known.insert(one.key);
    for (const SuiteCase& one : more) {
      if (known.count(one.key) == 0) cases.push_back(one);
    }
  }

  int Summarise(const std::vector<SuiteCase>& cases, Results& results) const {
    const std::map<std::string, ResultRow> rows = results.Rows();
    if (!quiet_) fmt::print("{}", SuiteSummary(cases, rows));
    const bool all_done = std::all_of(cases.begin(), cases.end(), [&](const SuiteCase& one) {
      return rows.at(one.key).result.status == CaseStatus::kFinished;
    });
    return all_done ? kDone : kFailure;
  }

  /// Prints each figure that is beyond its bound of the suite, or not defined in a case that is
  /// done, whatever a baseline says.
  bool WithinBounds(const std::vector<SuiteCase>& cases, Results& results) const {
    bool within = true;
    for (const auto& [key, found] : GatedCases(suite_, cases, results.Rows())) {
      for (const std::string& figure : eval::BeyondBounds(found.figures, suite_.gate.worst)) {
        fmt::print("BEYOND    {}: {}, bound {}  {}\n", figure, *found.figures.at(figure),
                   suite_.gate.worst.at(figure), key);
        within = false;
      }
      if (!found.done) continue;
      for (const std::string& figure :
           eval::UndefinedOfBounded(found.figures, suite_.gate.worst)) {
        fmt::print("BEYOND    {}: not defined, bound {}  {}\n", figure,
                   suite_.gate.worst.at(figure), key);
        within = false;
      }
    }
    return within;
  }

  /// Cases of variants that the gate does not look at, and which are not done.
  std::size_t OthersFailed(const std::vector<SuiteCase>& cases,
                           const std::map<std::string, ResultRow>& rows) const {
    const eval::GateCases gated = GatedCases(suite_, cases, rows);
    return static_cast<std::size_t>(
        std::count_if(cases.begin(), cases.end(), [&](const SuiteCase& one) {
          return gated.count(one.key) == 0 &&
                 rows.at(one.key).result.status != CaseStatus::kFinished;
        }));
  }

  /// The call that runs a case of this suite again, but for its key.
  std::string ReplayCall() const {
    std::vector<std::string> call{"pas", "suite", arguments_.suite, "-o", arguments_.output};
    if (!arguments_.program.empty()) call.insert(call.end(), {"--program", arguments_.program});
    if (!arguments_.recordings.empty())
      call.insert(call.end(), {"--recordings", arguments_.recordings});
    call.emplace_back("--replay");
    return CommandLines({call}) + " CASE";
  }

  int Verdict(const eval::GateReport& report, std::size_t others_failed) const {
    fmt::print("{}", eval::GateTable(report));
    if (others_failed > 0)
      fmt::print("WORSE     {} cases failed of variants that are not gated\n", others_failed);
    if (report.counts.empty()) {
      throw io::InputError(
          arguments_.baseline,
          "has no case of this suite, so nothing was compared; write one of it "
          "with --accept \"REASON\"");
    }
    const bool undecided = !report.UndecidedArms().empty();
    if (report.AnyWorse() || others_failed > 0) {
      fmt::print(
          "WORSE than {}; replay a case with `{}`, or accept it with --accept \"REASON\"\n",
          arguments_.baseline, ReplayCall());
      return kFailure;
    }
    if (!undecided) {
      fmt::print("the same as {}\n", arguments_.baseline);
      return kDone;
    }
    fmt::print("undecided with all seeds of the suite: look at the figures above{}\n",
               suite_.gate.undecided_passes ? "; the suite lets that pass"
                                            : ", and accept them with --accept \"REASON\"");
    return suite_.gate.undecided_passes ? kDone : kFailure;
  }

  /// The case of that key, of any seed of the suite.
  SuiteCase Named(const std::string& key) const {
    const std::vector<SuiteCase> all = Plan(suite_.seeds.max_count);
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const SuiteCase& one) { return one.key == key; });
    if (found == all.end()) {
      throw io::InputError(
          key, "is no case of this suite; its cases are named as " + all.front().key);
    }
    return *found;
  }

  int Shrink(const std::optional<eval::Baseline>& baseline) const {
    const SuiteCase one = Named(arguments_.shrink);
    const eval::Figures* before = nullptr;
    if (baseline) {
      RequireSameInputs(*baseline, {one});
      const auto found = baseline->cases.find(one.key);
      if (found != baseline->cases.end()) before = &found->second.figures;
    }
    const StopSignal stop;
    const ShrunkCase small = ShrinkCase(one, suite_, program_, folder_, before,
                                        [] { return StopSignal::Caught() != 0; });
    if (!quiet_ && !small.suite.empty()) {
      fmt::print(
          "{}\n{} frames of {} x {}, {} objects, after {} runs\n"
          "run it with `pas suite {} -o DIR`\n"
          "copied to tests/regressions/NAME, the folder {} is a test of ci/test, which fails "
          "until the fault is mended\n",
          small.failure, small.frames, small.width, small.height, small.objects, small.runs,
          small.suite.string(), small.suite.parent_path().string());
    }
    if (StopSignal::Caught() != 0) return ExitCodeOf(StopSignal::Caught());
    return kDone;
  }

  const SuiteArguments& arguments_;
  bool quiet_;
  SuiteFile suite_;
  SuiteProgram program_;
  SuiteShard shard_;
  fs::path folder_;
  mutable int caught_ = 0;
};

}  // namespace

int CallSuite(const SuiteArguments& arguments, bool quiet) {
  return SuiteCall(arguments, quiet).Run();
}

}  // namespace app
