#pragma once

#include <cstdint>
#include <cstring>

namespace slam {

/// Four numbers that are worked on at once; a vector of every machine we build for, and the
/// same arithmetic, in the same order, on each.
using Floats = float __attribute__((vector_size(16)));
using Ints = std::int32_t __attribute__((vector_size(16)));
inline constexpr int kLanes = 4;

inline Floats Load(const float* from) {
  Floats lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
inline Ints Load(const std::int32_t* from) {
  Ints lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
inline void Store(const Floats& lanes, float* to) { std::memcpy(to, &lanes, sizeof lanes); }
inline void Store(const Ints& lanes, std::int32_t* to) {
  std::memcpy(to, &lanes, sizeof lanes);
}

inline Floats All(float value) { return Floats{value, value, value, value}; }
inline Ints All(std::int32_t value) { return Ints{value, value, value, value}; }
inline Floats Magnitude(const Floats& a) { return a < All(0.0f) ? -a : a; }
inline Floats Least(const Floats& a, const Floats& b) { return a < b ? a : b; }
inline int Total(const Ints& a) { return a[0] + a[1] + a[2] + a[3]; }
inline double Total(const Floats& a) {
  return (static_cast<double>(a[0]) + static_cast<double>(a[1])) +
         (static_cast<double>(a[2]) + static_cast<double>(a[3]));
}

}  // namespace slam
