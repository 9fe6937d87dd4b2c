#pragma once

#include "slam/base/lanes.h"

// For sources that CMake's pas_lanes names.

namespace slam {

/// Eight numbers that one instruction works on where the processor can, and four doubles.
inline constexpr int kLanes = 8;
using FloatLanes = float __attribute__((vector_size(32)));
using IntLanes = int __attribute__((vector_size(32)));
using DoubleLanes = double __attribute__((vector_size(32)));

/// Read from and written to anywhere in an array. By bytes: a reference to lanes would promise
/// that they are aligned, whatever their type says (clang).
template <typename Vector, typename Number>
SLAM_INLINE Vector Load(const Number* p) {
  Vector lanes;
  __builtin_memcpy(&lanes, p, sizeof lanes);
  return lanes;
}
template <typename Vector, typename Number>
SLAM_INLINE void Store(const Vector& lanes, Number* p) {
  __builtin_memcpy(p, &lanes, sizeof lanes);
}
SLAM_INLINE FloatLanes Lanes(const float* p) { return Load<FloatLanes>(p); }
SLAM_INLINE DoubleLanes Lanes(const double* p) { return Load<DoubleLanes>(p); }

SLAM_INLINE FloatLanes AllLanes(float value) { return FloatLanes{} + value; }
SLAM_INLINE FloatLanes Abs(FloatLanes r) { return (FloatLanes)((IntLanes)r & 0x7fffffff); }
SLAM_INLINE int SumOf(IntLanes v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}
SLAM_INLINE double SumOf(DoubleLanes v) { return (v[0] + v[2]) + (v[1] + v[3]); }
/// Whether a comparison holds in any lane.
SLAM_INLINE bool AnyOf(IntLanes v) {
  int any = 0;
  for (int k = 0; k < kLanes; ++k) any |= v[k];
  return any != 0;
}

}  // namespace slam
