#include "eval/planes/partition_score.h"

#include <algorithm>
#include <cmath>

namespace eval {
namespace {

using Sizes = std::map<int, long long>;

double PairsAmong(double n) { return 0.5 * n * (n - 1.0); }

double PairsWithin(const Sizes& parts) {
  double pairs = 0.0;
  for (const auto& [label, n] : parts) pairs += PairsAmong(static_cast<double>(n));
  return pairs;
}

/// Sum over the parts of what `best` holds of each.
template <typename Value>
double Sum(const std::map<int, Value>& best) {
  double sum = 0.0;
  for (const auto& [label, value] : best) sum += static_cast<double>(value);
  return sum;
}

}  // namespace

PartitionScore ScorePartition(const LabelPairs& pairs) {
  PartitionScore score;
  Sizes truth, machine;
  double things = 0.0, together = 0.0;  // together: pairs that both keep together
  for (const auto& [labels, n] : pairs) {
    truth[labels.first] += n;
    machine[labels.second] += n;
    things += static_cast<double>(n);
    together += PairsAmong(static_cast<double>(n));
  }
  if (!(things > 0.0)) return score;
  if (things > 1.0) {
    const double apart = PairsWithin(truth) + PairsWithin(machine) - 2.0 * together;
    score.rand_index = 1.0 - apart / PairsAmong(things);
  }

  Sizes most_of_truth, most_of_machine;
  std::map<int, double> covered_truth, covered_machine;
  for (const auto& [labels, count] : pairs) {
    if (count == 0) continue;
    const auto& [t, m] = labels;
    const auto n = static_cast<double>(count);
    const auto n_t = static_cast<double>(truth.at(t)), n_m = static_cast<double>(machine.at(m));
    score.truth_given_machine_bits += n / things * std::log2(n_m / n);
    score.machine_given_truth_bits += n / things * std::log2(n_t / n);
    most_of_truth[t] = std::max(most_of_truth[t], count);
    most_of_machine[m] = std::max(most_of_machine[m], count);
    const double iou = n / (n_t + n_m - n);
    covered_truth[t] = std::max(covered_truth[t], n_t * iou);
    covered_machine[m] = std::max(covered_machine[m], n_m * iou);
  }
  score.purity = Sum(most_of_machine) / things;
  score.inverse_purity = Sum(most_of_truth) / things;
  score.covering = 0.5 * (Sum(covered_truth) + Sum(covered_machine)) / things;
  return score;
}

}  // namespace eval
