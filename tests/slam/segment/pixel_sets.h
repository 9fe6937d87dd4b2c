// Single pixels of a PixelSet.
#pragma once

#include "slam/segment/pixels/pixel_set.h"

namespace slam {

constexpr PixelSet PixelOf(int u, int v) { return PixelSet{1} << (kBlock_px * u + v); }
constexpr bool IsInSet(PixelSet set, int u, int v) { return (set & PixelOf(u, v)) != 0; }

}  // namespace slam
