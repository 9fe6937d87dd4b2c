#include "app/suite/run_suite.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "app/console/console.h"

namespace app {
namespace {

/// What `--replay` and the command of a row call the program, whatever its path is here.
constexpr const char* kAnyProgram = "pas";
constexpr const char* kReplayRun = "replay";

/// Whether a row is what the case would be now. Other limits may let it go on to its end.
bool IsOf(const ResultRow& row, const SuiteCase& one, const SuiteLimits& limits,
          bool retry_failed) {
  const CaseStatus status = row.result.status;
  if (retry_failed && status != CaseStatus::kFinished) return false;
  const bool limited = status == CaseStatus::kTimedOut || status == CaseStatus::kOutOfMemory;
  return row.inputs_sha256 == one.inputs_sha256 &&
         (!limited || row.result.message == LimitMessage(status, limits));
}

/// Cases that several threads take one by one.
class CaseQueue {
 public:
  CaseQueue(const std::vector<SuiteCase>& cases, const SuiteRunOptions& options,
            Results& results)
      : options_(options), results_(results) {
    const std::map<std::string, ResultRow> rows = results.Rows();
    for (const SuiteCase& one : cases) {
      const auto row = rows.find(one.key);
      if (row == rows.end() || !IsOf(row->second, one, options.limits, options.retry_failed)) {
        pending_.push_back(&one);
      }
    }
  }

  bool Run() {
    if (pending_.empty()) return false;
    Progress progress("cases", static_cast<int>(pending_.size()), options_.quiet);
    std::vector<std::thread> workers;
    workers.reserve(static_cast<std::size_t>(options_.jobs));
    for (int i = 0; i < options_.jobs; ++i) workers.emplace_back([&] { Work(progress); });
    for (std::thread& worker : workers) worker.join();
    if (error_) std::rethrow_exception(error_);
    return stopped_;
  }

 private:
  bool Ending() const { return failed_ || stopped_ || options_.stop(); }

  void Work(Progress& progress) {
    try {
      for (std::size_t i; !Ending() && (i = next_++) < pending_.size();) {
        const SuiteCase& one = *pending_[i];
        const CaseResult result = RunCase(one, options_.program, options_.limits,
                                          options_.folder, [&] { return Ending(); });
        const std::lock_guard lock(mutex_);
        if (result.status == CaseStatus::kStopped) stopped_ = true;
        if (stopped_) break;
        options_.program.RequireUnchanged();
        results_.Put(one, result, options_.version,
                     CommandLines(CommandsOf(one, kAnyProgram, kReplayRun)));
        progress.Update(++done_);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      failed_ = true;
    }
    if (options_.stop()) stopped_ = true;
  }

  const SuiteRunOptions& options_;
  Results& results_;
  std::vector<const SuiteCase*> pending_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false, stopped_ = false;
  std::mutex mutex_;  ///< of what follows, of the results and of the progress
  int done_ = 0;
  std::exception_ptr error_;
};

}  // namespace

bool RunCases(const std::vector<SuiteCase>& cases, const SuiteRunOptions& options,
              Results& results) {
  return CaseQueue(cases, options, results).Run();
}

}  // namespace app
