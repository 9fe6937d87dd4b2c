#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/suite/suite_file.h"

namespace app {

/// How a process of a case ended.
struct ChildOutcome {
  enum class End {
    kExited,     ///< `code` is its exit code
    kSignalled,  ///< `code` is the signal
    kTimedOut,
    kStopped,  ///< because the suite was asked to stop
  };
  End end = End::kExited;
  int code = 0;
  double seconds = 0.0;  ///< wall time
  double peak_mb = 0.0;  ///< the most memory it had at a time, 2^20 bytes
  std::string errors;    ///< the end of its error output
};

/// Runs a program in a process group of its own, in `folder`, with its error output in the file
/// `errors` and its standard output thrown away. It gets no more data memory than the limits say,
/// is killed when its time is over, and does not outlive this process.
/// @param stop  asked some times a second; true ends the process
/// @throws InputError when no process can be made
ChildOutcome RunChild(const std::vector<std::string>& command,
                      const std::filesystem::path& folder, const std::filesystem::path& errors,
                      const SuiteLimits& limits, const std::function<bool()>& stop);

}  // namespace app
