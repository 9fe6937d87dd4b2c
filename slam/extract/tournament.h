#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace slam {

/// Which of many costs, each of which may change, is the least; of equal ones the first. Takes
/// the same few steps for every change, without a branch that depends on the costs: for costs
/// that change often it is faster than a heap.
class Tournament {
 public:
  static constexpr double kOut = std::numeric_limits<double>::infinity();

  /// @param costs  not NaN; kOut: does not take part
  void Begin(const std::vector<double>& costs) {
    leaves_ = std::bit_ceil(costs.size() + 1);
    costs_ = costs;
    costs_.resize(leaves_, kOut);
    winners_.resize(2 * leaves_);
    std::iota(winners_.begin() + static_cast<std::ptrdiff_t>(leaves_), winners_.end(), 0);
    for (std::size_t node = leaves_ - 1; node > 0; --node) {
      const int left = winners_[2 * node], right = winners_[2 * node + 1];
      winners_[node] = CostOf(right) < CostOf(left) ? right : left;
    }
  }

  int winner() const { return winners_[1]; }
  /// kOut: nobody takes part any more.
  double least() const { return CostOf(winners_[1]); }

  void Change(int k, double cost) {
    costs_[static_cast<std::size_t>(k)] = cost;
    int winner = k;
    for (std::size_t node = leaves_ + static_cast<std::size_t>(k); node > 1; node /= 2) {
      const int other = winners_[node ^ 1];
      const double other_cost = CostOf(other);
      const int loses =
          static_cast<int>(other_cost < cost) |
          (static_cast<int>(other_cost == cost) & static_cast<int>(other < winner));
      winner ^= (winner ^ other) & -loses;  // no branch: it could not be foreseen
      cost = std::min(cost, other_cost);
      winners_[node / 2] = winner;
    }
  }

 private:
  double CostOf(int k) const { return costs_[static_cast<std::size_t>(k)]; }

  std::size_t leaves_ = 1;  ///< a power of two
  std::vector<double> costs_;
  std::vector<int> winners_;  ///< node k is above 2 k and 2 k + 1; the last half are the costs
};

}  // namespace slam
