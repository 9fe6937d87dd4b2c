#include "eval/formats/stamps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/stamp_unit.h"

namespace eval {
std::optional<std::size_t> FindStamp(const std::vector<double>& stamps_s, double stamp_s) {
  const auto from = std::lower_bound(stamps_s.begin(), stamps_s.end(), stamp_s - kSameStamp_s);
  if (from == stamps_s.end() || !(*from <= stamp_s + kSameStamp_s)) return std::nullopt;
  return static_cast<std::size_t>(from - stamps_s.begin());
}

std::optional<std::size_t> NearestStamp(const std::vector<double>& stamps_s, double t_s,
                                        double max_difference_s) {
  auto nearest = std::lower_bound(stamps_s.begin(), stamps_s.end(), t_s);
  if (nearest != stamps_s.begin() &&
      (nearest == stamps_s.end() || t_s - *(nearest - 1) <= *nearest - t_s)) {
    // The first of equal ones.
    nearest = std::lower_bound(stamps_s.begin(), nearest, *(nearest - 1));
  }
  if (nearest == stamps_s.end() || std::abs(*nearest - t_s) > max_difference_s) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(nearest - stamps_s.begin());
}

std::optional<std::size_t> FindFrame(const std::vector<double>& stamps_s, double frame_s,
                                     bool synthetic) {
  return synthetic ? FindStamp(stamps_s, frame_s)
                   : NearestStamp(stamps_s, frame_s, kMaxStampDifference_s);
}

bool StampOrder::Next(double stamp_s, int line) {
  const auto from = seen_s_.lower_bound(stamp_s - kSameStamp_s);
  // A time that came before others is out of order, whether it is a new one or not.
  const bool goes_back = !stamps_s_.empty() && stamp_s < stamps_s_.back() - kSameStamp_s;
  const bool seen = from != seen_s_.end() && *from <= stamp_s + kSameStamp_s;
  // Of a time that is both, the graver is told.
  const bool repeats = seen && (!goes_back || repetition_ < disorder_);
  if (repeats || (!stamps_s_.empty() && !(stamp_s > stamps_s_.back()))) {
    folder_.Tell(file_, line,
                 fmt::format("time stamp {:.6f} {}; stamps must increase strictly", stamp_s,
                             repeats ? "comes a second time"
                                     : fmt::format("does not follow {:.6f}", stamps_s_.back())),
                 repeats ? "keep one record of each time" : "sort the records by time",
                 repeats ? repetition_ : disorder_);
  }
  stamps_s_.push_back(stamp_s);
  seen_s_.insert(stamp_s);
  return !seen;
}

void StampOrder::Finish() {
  if (stamps_s_.empty()) return;
  const double first = *std::min_element(stamps_s_.begin(), stamps_s_.end());
  if (first < 0) {
    folder_.Tell(file_, 0, fmt::format("has negative time stamps, such as {:.6f}", first),
                 "add one number of seconds to all times, as pas slam takes none below 0",
                 Severity::kFlaw);
  }
  if (io::CanBeSeconds(stamps_s_)) return;
  const double latest = *std::max_element(stamps_s_.begin(), stamps_s_.end());
  folder_.Tell(file_, 0, fmt::format("time stamps like {:.0f} are not seconds", latest),
               "write stamps in seconds (divide nanoseconds by 1e9, milliseconds by 1e3)");
}

}  // namespace eval
