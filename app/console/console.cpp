#include "app/console/console.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace app {

std::string RateText(int done, int total, double seconds) {
  constexpr double kTooSoon_s = 0.2;  // the first steps say nothing of the rate yet
  if (!(seconds > kTooSoon_s) || done <= 0) return "";
  constexpr double kMinute_s = 60.0;
  const double rate = done / seconds;
  std::string text = rate < 1.0 ? ", " + std::to_string(std::lround(kMinute_s * rate)) + "/min"
                                : ", " + std::to_string(std::lround(rate)) + "/s";
  if (done >= total) return text;
  const long left_s = std::lround(seconds * (total - done) / done);
  const std::string part = std::to_string(left_s % 60);
  return text + ", " + std::to_string(left_s / 60) + ":" + (part.size() < 2 ? "0" : "") + part +
         " left";
}

Progress::Progress(std::string label, int total, bool quiet)
    : label_(std::move(label)),
      total_(total > 0 ? total : 1),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (!quiet_ && terminal_ && last_shown_ >= 0) std::fputc('\n', stderr);
}

void Progress::Update(int done) {
  if (quiet_) return;
  const int steps = terminal_ ? 100 : 10;
  const int step = static_cast<int>(static_cast<long>(done) * steps / total_);
  if (step == last_shown_ || (!terminal_ && step == 0)) return;
  last_shown_ = step;

  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const std::string rate = RateText(done, total_, seconds);
  if (terminal_) {
    std::string bar(static_cast<std::size_t>(step * 30 / steps), '#');
    bar.resize(30, '.');
    std::fprintf(stderr, "\r%s [%s] %d/%d%s \033[K", label_.c_str(), bar.c_str(), done, total_,
                 rate.c_str());
  } else {
    std::fprintf(stderr, "%s %d/%d%s\n", label_.c_str(), done, total_, rate.c_str());
  }
  std::fflush(stderr);
}

void PassProgress::Update(const std::string& pass, int done, int total) {
  if (!progress_ || pass != pass_) {
    progress_.reset();  // ends its line before the next begins
    progress_.emplace(pass, total, quiet_);
    pass_ = pass;
  }
  progress_->Update(done);
}

void PrintAside(const std::string& text) { std::fputs(text.c_str(), stderr); }

void PrintWarning(const std::string& warning) { PrintAside("pas: warning: " + warning + "\n"); }

}  // namespace app
