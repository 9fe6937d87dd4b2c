#pragma once

#include <cstdint>

#include "slam/base/lane_math.h"

// Sets of the pixels of a block of 8 x 8 and rows of it, one lane a column. For sources that
// CMake's pas_lanes names.

namespace slam {

/// Makes a set of rows, the last one first.
class RowsOfSet {
 public:
  /// @param row  result of a comparison
  SLAM_INLINE void Add(IntLanes row) { columns_ = columns_ + columns_ - row; }
  SLAM_INLINE std::uint64_t Set() const {
    const Shorts narrow = __builtin_convertvector(columns_, Shorts);
    return (std::uint64_t) __builtin_convertvector(narrow, Bytes);
  }

 private:
  using Shorts = std::int16_t __attribute__((vector_size(16)));
  using Bytes = std::int8_t __attribute__((vector_size(8)));
  IntLanes columns_{};
};

/// The columns of a set, for RowOf.
SLAM_INLINE IntLanes ColumnsOf(std::uint64_t set) {
  const int left = static_cast<int>(set & 0xffffffffu), right = static_cast<int>(set >> 32);
  return IntLanes{left, left, left, left, right, right, right, right} >>
         IntLanes{0, 8, 16, 24, 0, 8, 16, 24};
}

/// As a comparison's result.
SLAM_INLINE IntLanes RowOf(IntLanes columns, int v) { return columns << (31 - v) >> 31; }

}  // namespace slam
