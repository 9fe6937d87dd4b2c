#pragma once

#include "slam/base/lanes.h"

// For sources that CMake's pas_lanes names.

namespace slam {

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
