#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace app {

/// How fast it goes and how long it still takes at that pace: ", 12/s, 1:05 left" (minutes and
/// seconds; what is slower than 1/s, by the minute); empty when it is too soon to tell, without an end when all is done.
std::string RateText(int done, int total, double seconds);

/// Progress of a long job on stderr: a bar when stderr is a terminal, else a plain line about
/// every ten per cent; silent when quiet. Never part of a result.
class Progress {
 public:
  Progress(std::string label, int total, bool quiet);
  ~Progress();
  /// Reports that `done` of the total steps are finished.
  void Update(int done);

 private:
  std::string label_;
  int total_;
  bool quiet_;
  bool terminal_;
  int last_shown_ = -1;
  std::chrono::steady_clock::time_point start_;
};

/// Progress of a job in passes, each with its own name and count.
class PassProgress {
 public:
  explicit PassProgress(bool quiet) : quiet_(quiet) {}
  void Update(const std::string& pass, int done, int total);
  /// Ends the line of the pass that is shown.
  void End() { progress_.reset(); }

 private:
  bool quiet_;
  std::string pass_;
  std::optional<Progress> progress_;
};

/// Prints on stderr. That nobody can read it, as on a full disk, fails no command: its result is
/// elsewhere.
void PrintAside(const std::string& text);

/// Says on stderr what should be known beside a result, in a line of its own.
void PrintWarning(const std::string& warning);

}  // namespace app
