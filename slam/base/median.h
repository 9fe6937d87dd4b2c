#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace slam {

/// Standard deviation of a normal variable over the median of its absolute deviations.
inline constexpr double kSigmaOverMad = 1.4826;

/// The value in the middle of all, in order; the lesser of two. @pre not empty
template <typename Number>
Number LowerMedian(std::vector<Number> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Likewise; the greater of two. @pre not empty
template <typename Number>
Number UpperMedian(std::vector<Number> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace slam
