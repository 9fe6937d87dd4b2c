#include "eval/check/checked_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace eval {
namespace {

// Seconds since 1970 reach 1e11 in the year 5138; milliseconds passed it in 1973.
constexpr double kLargestStamp_s = 1e11;
// Nobody records a frame every quarter of an hour; a 1 Hz recording in milliseconds has this
// gap.
constexpr double kLargestMedianGap_s = 900;

}  // namespace

std::vector<CheckedLine> RecordsToCheck(FolderCheck& check, const std::string& file) {
  std::vector<CheckedLine> records;
  std::ifstream in(check.root / file);
  if (!in) {
    check.Add(file, 0, "cannot be read", "restore the file and its permissions");
    return records;
  }
  check.files.insert(file);
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    std::istringstream split(text);
    CheckedLine record{number, text, {}};
    for (std::string word; split >> word;) record.words.push_back(word);
    if (record.words.empty() || record.words[0][0] == '#') continue;
    records.push_back(std::move(record));
  }
  return records;
}

StampOrder::StampOrder(FolderCheck& check, std::string file)
    : check_(check), file_(std::move(file)) {}

void StampOrder::Next(double stamp_s, int line) {
  if (!stamps_s_.empty() && !(stamp_s > stamps_s_.back())) {
    check_.Add(
        file_, line,
        fmt::format("time stamp {:.6f} does not follow {:.6f}; stamps must increase strictly",
                    stamp_s, stamps_s_.back()),
        "sort the records by time and drop duplicates");
  }
  stamps_s_.push_back(stamp_s);
}

void StampOrder::Finish() {
  if (stamps_s_.empty()) return;
  std::vector<double> gaps;
  for (std::size_t i = 1; i < stamps_s_.size(); ++i) {
    gaps.push_back(std::abs(stamps_s_[i] - stamps_s_[i - 1]));
  }
  std::sort(gaps.begin(), gaps.end());
  const double largest = *std::max_element(stamps_s_.begin(), stamps_s_.end());
  const bool slow = gaps.size() >= 2 && gaps[gaps.size() / 2] > kLargestMedianGap_s;
  if (!(largest > kLargestStamp_s) && !slow) return;
  check_.Add(file_, 0, fmt::format("time stamps like {:.0f} are not seconds", largest),
             "write stamps in seconds (divide nanoseconds by 1e9, milliseconds by 1e3)");
}

std::optional<std::size_t> NearestStamp(const std::vector<double>& stamps_s, double t_s,
                                        double max_difference_s) {
  const auto after = std::lower_bound(stamps_s.begin(), stamps_s.end(), t_s);
  std::optional<std::size_t> best;
  double best_difference = max_difference_s;
  for (auto it = after == stamps_s.begin() ? after : after - 1; it != stamps_s.end(); ++it) {
    if (it > after) break;
    const double difference = std::abs(*it - t_s);
    if (difference > best_difference) continue;
    best = static_cast<std::size_t>(it - stamps_s.begin());
    best_difference = difference;
  }
  return best;
}

}  // namespace eval
