#pragma once

#include <cstdint>

namespace slam {

/// A set of the pixels of a block of 8 x 8: a column in each byte.
using PixelSet = std::uint64_t;

inline constexpr int kBlock_px = 8;  ///< side of a block: a row has a lane's width
inline constexpr int kQuarter_px = kBlock_px / 2;  ///< side of the blocks of the second look

inline constexpr PixelSet kWholeBlock = ~PixelSet{0};
inline constexpr PixelSet kLastRow = 0x8080808080808080;

/// The pixels of the quarter of a block that begins at (u, v).
constexpr PixelSet QuarterAt(int u, int v) {
  return PixelSet{0x0f0f0f0f} << (kBlock_px * u + v);
}

}  // namespace slam
