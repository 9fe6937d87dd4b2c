#include "slam/base/degrees.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

namespace slam {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

double WithDigits(double x, int digits) {
  char buffer[32];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, digits);
  double rounded = x;
  std::from_chars(buffer, end, rounded);
  return rounded;
}

}  // namespace

double RadiansOf(double degrees) { return degrees * kDegree_rad; }

double DegreesOf(double radians) {
  const double nearest = radians / kDegree_rad;
  for (int digits = 1; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    const double rounded = WithDigits(nearest, digits);
    if (RadiansOf(rounded) == radians) return rounded;
  }
  // The quotient is rounded too: its neighbours may give the product that it misses.
  double below = nearest, above = nearest;
  for (int step = 0; step < 2; ++step) {
    below = std::nextafter(below, -std::numeric_limits<double>::infinity());
    above = std::nextafter(above, std::numeric_limits<double>::infinity());
    if (RadiansOf(below) == radians) return below;
    if (RadiansOf(above) == radians) return above;
  }
  return nearest;
}

}  // namespace slam
