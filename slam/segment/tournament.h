#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace slam {

/// Which of many costs, each of which may change, is the least; of equal ones the first. Takes
/// the same few steps for every change, without a branch that depends on the costs: for costs
/// that change often it is faster than a heap.
///
/// What is compared are the bits of a cost with its number in place of the lowest ones, so that
/// costs that differ by less than some 1e-11 of themselves are equal.
class Tournament {
 public:
  static constexpr double kOut = std::numeric_limits<double>::infinity();

  /// @param costs  not NaN; kOut: does not take part
  void Begin(const std::vector<double>& costs) {
    leaves_ = std::bit_ceil(costs.size() + 1);
    costs_ = costs;
    keys_.resize(2 * leaves_);
    for (std::size_t k = 0; k < leaves_; ++k)
      keys_[leaves_ + k] = k < costs.size() ? KeyOf(k, costs[k]) : kLast;
    for (std::size_t node = leaves_ - 1; node > 0; --node)
      keys_[node] = std::min(keys_[2 * node], keys_[2 * node + 1]);
  }

  int winner() const { return keys_[1] == kLast ? 0 : static_cast<int>(NumberOf(keys_[1])); }
  /// kOut: nobody takes part any more.
  double least() const { return keys_[1] == kLast ? kOut : costs_[NumberOf(keys_[1])]; }

  void Change(int k, double cost) {
    const auto number = static_cast<std::size_t>(k);
    costs_[number] = cost;
    std::int64_t key = KeyOf(number, cost);
    for (std::size_t node = leaves_ + number; node > 0; node /= 2) {
      keys_[node] = key;
      key = std::min(key, keys_[node ^ 1]);
    }
  }

 private:
  static constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();

  /// In the order of costs, then of numbers.
  std::int64_t KeyOf(std::size_t k, double cost) const {
    if (cost == kOut) return kLast;
    const auto bits = std::bit_cast<std::int64_t>(cost);
    const std::int64_t ordered = bits < 0 ? bits ^ kLast : bits;
    return (ordered & ~Numbers()) | static_cast<std::int64_t>(k);
  }
  std::size_t NumberOf(std::int64_t key) const {
    return static_cast<std::size_t>(key & Numbers());
  }
  std::int64_t Numbers() const { return static_cast<std::int64_t>(leaves_) - 1; }

  std::size_t leaves_ = 1;  ///< a power of two
  std::vector<double> costs_;
  std::vector<std::int64_t> keys_;  ///< node k is above 2 k and 2 k + 1; the last half are all
};

}  // namespace slam
