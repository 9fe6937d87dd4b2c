#pragma once

#include <array>
#include <csignal>

namespace app {

/// While it lives, SIGINT (Ctrl-C), SIGTERM and SIGHUP ask for an end after the work in hand; a
/// second one of the same kind ends at once. A signal that is ignored (nohup) stays so. One
/// object at a time.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// The number of the signal that came; 0 when none did.
  static int Caught();

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_{};
};

/// Exit code of a program that a signal ended, as shells say it.
inline int ExitCodeOf(int signal) { return 128 + signal; }

}  // namespace app
