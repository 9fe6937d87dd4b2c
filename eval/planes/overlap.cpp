#include "eval/planes/overlap.h"

#include <cstdint>
#include <stdexcept>
#include <unordered_map>

namespace eval {

long long Overlap::Shared(int truth, int machine) const {
  const auto row = shared.find(truth);
  if (row == shared.end()) return 0;
  const auto entry = row->second.find(machine);
  return entry == row->second.end() ? 0 : entry->second;
}

double Overlap::IoU(int truth, int machine) const {
  const auto both = static_cast<double>(Shared(truth, machine));
  if (!(both > 0.0)) return 0.0;
  const auto sum = static_cast<double>(truth_pixels.at(truth) + machine_pixels.at(machine));
  return both / (sum - both);
}

LabelPairs CountPairs(const cv::Mat1w& truth, const cv::Mat1w& machine) {
  if (truth.size() != machine.size()) {
    throw std::invalid_argument("CountPairs: the images differ in size");
  }
  // Neighbours mostly repeat: count runs of equal pairs.
  constexpr int kLabelBits = 16;
  std::unordered_map<std::uint32_t, long long> counts;
  for (int y = 0; y < truth.rows; ++y) {
    const std::uint16_t* t = truth[y];
    const std::uint16_t* m = machine[y];
    for (int x = 0; x < truth.cols;) {
      int end = x + 1;
      while (end < truth.cols && t[end] == t[x] && m[end] == m[x]) ++end;
      counts[std::uint32_t{t[x]} << kLabelBits | m[x]] += end - x;
      x = end;
    }
  }
  LabelPairs pairs;
  for (const auto& [labels, count] : counts) {
    pairs[{static_cast<int>(labels >> kLabelBits), static_cast<std::uint16_t>(labels)}] = count;
  }
  return pairs;
}

Overlap OverlapOf(const LabelPairs& pairs) {
  Overlap overlap;
  for (const auto& [labels, count] : pairs) {
    const auto& [t, m] = labels;
    if (t != 0) overlap.truth_pixels[t] += count;
    if (m != 0) overlap.machine_pixels[m] += count;
    if (t != 0 && m != 0) overlap.shared[t][m] += count;
  }
  return overlap;
}

Overlap CountOverlap(const cv::Mat1w& truth, const cv::Mat1w& machine) {
  return OverlapOf(CountPairs(truth, machine));
}

}  // namespace eval
