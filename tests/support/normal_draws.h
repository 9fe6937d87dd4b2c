#pragma once

#include <cmath>

#include "slam/base/random.h"

namespace slam {

/// Standard normal, by Box and Muller.
inline double Normal(Random& random) {
  const double u = 1 - random.Uniform(), v = random.Uniform();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v);
}

/// Standard normal near enough for noise, and never beyond six: the sum of twelve uniforms.
inline double BoundedNormal(Random& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += random.Uniform();
  return sum;
}

}  // namespace slam
