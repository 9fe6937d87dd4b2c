#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "slam/base/index.h"

namespace slam {

/// A value for each pair of labels that touch.
template <typename Value>
class LabelPairs {
 public:
  explicit LabelPairs(std::size_t label_count) : of_lower_(label_count) {}

  /// The value of a pair; a new one is Value{}. Another pair may move it.
  Value& Of(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    auto& values = of_lower_[Index(low)];
    for (auto& [other, value] : values)
      if (other == high) return value;
    return values.emplace_back(high, Value{}).second;
  }

  /// Calls visit(low, high, value) for every pair that was asked for, in order of the labels.
  template <typename Visit>
  void VisitSorted(const Visit& visit) {
    for (std::size_t low = 0; low < of_lower_.size(); ++low) {
      auto& values = of_lower_[low];
      std::sort(values.begin(), values.end(),
                [](const auto& a, const auto& b) { return a.first < b.first; });
      for (auto& [high, value] : values) visit(static_cast<int>(low), high, value);
    }
  }

 private:
  std::vector<std::vector<std::pair<int, Value>>> of_lower_;  ///< by the higher label
};

}  // namespace slam
