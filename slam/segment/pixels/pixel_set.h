#pragma once

#include <cstdint>

namespace slam {

/// A set of the pixels of a block of 8 x 8: a column in each byte.
using PixelSet = std::uint64_t;

inline constexpr int kBlock_px = 8;  ///< side of a block: a row has a lane's width
inline constexpr int kQuarter_px = kBlock_px / 2;  ///< side of the blocks of the second look

/// A square within a block: the block itself or a quarter of it.
struct BlockWindow {
  int u = 0, v = 0, side = kBlock_px;

  constexpr PixelSet Pixels() const {
    constexpr PixelSet kQuarter = 0x0f0f0f0f;
    return side == kBlock_px ? ~PixelSet{0} : kQuarter << (kBlock_px * u + v);
  }
};

}  // namespace slam
