#pragma once

#include <string>
#include <string_view>

namespace io {

/// A set of allowed numbers, written as in mathematics: "(0, inf)", "[0, 1]", "[1, 10)".
class Interval {
 public:
  /// The numbers from `min` to `max`, both of them allowed.
  Interval(double min, double max);
  /// @throws std::invalid_argument for text that is no interval (a mistake of the programmer)
  explicit Interval(std::string_view text);

  /// NaN and infinity are in no interval.
  bool Contains(double x) const;
  const std::string& text() const { return text_; }

 private:
  double min_, max_;
  bool closed_min_ = true, closed_max_ = true;  ///< the bound itself is allowed
  std::string text_;
};

}  // namespace io
