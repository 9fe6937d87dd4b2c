#include "io/interval.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "io/number_text.h"

namespace io {
namespace {

double ParseBound(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  const auto number = ParseNumber(text);
  if (!number) throw std::invalid_argument("Interval: a bound is not a number");
  return *number;
}

/// Whole numbers without exponent.
std::string BoundText(double bound) {
  constexpr double kMaxWhole = 1e15;  // whole numbers below it have no rounding error
  const bool whole = bound == std::floor(bound) && std::abs(bound) < kMaxWhole;
  return whole ? std::to_string(static_cast<long long>(bound)) : NumberText(bound);
}

}  // namespace

Interval::Interval(double min, double max) : min_(min), max_(max), text_("[") {
  text_.append(BoundText(min)).append(", ").append(BoundText(max)).append("]");
}

Interval::Interval(std::string_view text) : text_(text) {
  const std::size_t comma = text.find(',');
  const auto one_of = [](char c, char a, char b) { return c == a || c == b; };
  if (text.size() < 5 || comma == std::string_view::npos || !one_of(text.front(), '(', '[') ||
      !one_of(text.back(), ')', ']')) {
    throw std::invalid_argument("Interval: expected a text such as (0, 1] or [0, inf)");
  }
  closed_min_ = text.front() == '[';
  closed_max_ = text.back() == ']';
  min_ = ParseBound(text.substr(1, comma - 1));
  max_ = ParseBound(text.substr(comma + 1, text.size() - comma - 2));
}

bool Interval::Contains(double x) const {
  if (!std::isfinite(x)) return false;
  return (closed_min_ ? x >= min_ : x > min_) && (closed_max_ ? x <= max_ : x < max_);
}

}  // namespace io
