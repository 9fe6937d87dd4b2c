#include "app/suite/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <system_error>

#include "io/input_error.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCannotStart = 127;      // exit code, as shells say it
constexpr int kAskEvery_ms = 100;      // how late a stop may be noticed
constexpr int kMaxShown_bytes = 4000;  // of the error output: the last lines matter

/// Between fork and exec: nothing but calls that are safe there.
[[noreturn]] void Become(char* const* command, const char* folder, const char* errors,
                         rlim_t data_bytes, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kCannotStart);  // it ended before the line above
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) ::signal(signal, SIG_DFL);
  const rlimit data{data_bytes, data_bytes}, no_core{0, 0};
  ::setrlimit(RLIMIT_DATA, &data);
  ::setrlimit(RLIMIT_CORE, &no_core);
  const int nothing = ::open("/dev/null", O_RDWR);
  const int log = ::open(errors, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  if (::chdir(folder) == 0) ::execv(command[0], command);
  ::_exit(kCannotStart);
}

std::string EndOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(0, size - kMaxShown_bytes));
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Waits until the process has ended, its time is over or a stop is asked for.
ChildOutcome::End Await(int process, Clock::time_point end, const std::function<bool()>& stop) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return ChildOutcome::End::kTimedOut;
    if (stop()) return ChildOutcome::End::kStopped;
    pollfd ended{process, POLLIN, 0};
    const int ready =
        ::poll(&ended, 1, static_cast<int>(std::min<std::int64_t>(left, kAskEvery_ms)));
    if (ready > 0) return ChildOutcome::End::kExited;
  }
}

}  // namespace

ChildOutcome RunChild(const std::vector<std::string>& command,
                      const std::filesystem::path& folder, const std::filesystem::path& errors,
                      const SuiteLimits& limits, const std::function<bool()>& stop) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& text : command) arguments.push_back(const_cast<char*>(text.c_str()));
  arguments.push_back(nullptr);
  const rlim_t data_bytes = static_cast<rlim_t>(limits.memory_mb) << 20;
  const pid_t parent = ::getpid();
  const auto begin = Clock::now();
  const pid_t child = ::fork();
  if (child == 0) Become(arguments.data(), folder.c_str(), errors.c_str(), data_bytes, parent);
  const int process = child < 0 ? -1 : static_cast<int>(::syscall(SYS_pidfd_open, child, 0));
  if (process < 0) {
    const std::string reason = std::system_category().message(errno);
    if (child > 0) {
      ::kill(child, SIGKILL);
      ::waitpid(child, nullptr, 0);
    }
    throw io::InputError("the system",
                         "no process can be made (" + reason + "); use a smaller -j");
  }

  ChildOutcome outcome;
  const std::chrono::duration<double> time(limits.seconds);
  outcome.end = Await(process, begin + std::chrono::duration_cast<Clock::duration>(time), stop);
  // All that it started ends with it; until it is waited for, the number is its own.
  ::kill(-child, SIGKILL);
  ::kill(child, SIGKILL);
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  ::close(process);
  outcome.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  outcome.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024;
  if (outcome.end == ChildOutcome::End::kExited) {
    if (WIFSIGNALED(status)) outcome.end = ChildOutcome::End::kSignalled;
    outcome.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }
  outcome.errors = EndOf(errors);
  return outcome;
}

}  // namespace app
