#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace slam {

/// The smallest of many costs, each of which may change; of equal ones the first. A tree of
/// minima: a change takes the same few steps whatever the costs are, without a branch that
/// depends on them.
///
/// Our own because clustering changes the smallest cost again and again: with std::push_heap
/// and std::pop_heap the whole extraction took 7 % more instructions (callgrind, a desk of
/// kinect1).
///
/// What is compared are the bits of a cost with its number in place of the lowest ones, so that
/// costs that differ by less than some 1e-11 of themselves are equal.
class MinTree {
 public:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  /// @param costs  not NaN; kNone: does not take part
  void Begin(const std::vector<double>& costs) {
    leaves_ = std::bit_ceil(costs.size() + 1);
    keys_.resize(2 * leaves_);
    for (std::size_t k = 0; k < leaves_; ++k)
      keys_[leaves_ + k] = k < costs.size() ? KeyOf(k, costs[k]) : kLast;
    for (std::size_t node = leaves_ - 1; node > 0; --node)
      keys_[node] = std::min(keys_[2 * node], keys_[2 * node + 1]);
  }

  /// Whether none takes part.
  bool empty() const { return keys_[1] == kLast; }
  /// The number of the smallest cost; requires one.
  int first() const { return static_cast<int>(keys_[1] & Numbers()); }

  void Change(int k, double cost) {
    const auto number = static_cast<std::size_t>(k);
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
    if (cost == kNone) return kLast;
    const auto bits = std::bit_cast<std::int64_t>(cost);
    const std::int64_t ordered = bits < 0 ? bits ^ kLast : bits;
    return (ordered & ~Numbers()) | static_cast<std::int64_t>(k);
  }
  std::int64_t Numbers() const { return static_cast<std::int64_t>(leaves_) - 1; }

  std::size_t leaves_ = 1;          ///< a power of two
  std::vector<std::int64_t> keys_;  ///< node k is above 2 k and 2 k + 1; the last half are all
};

}  // namespace slam
