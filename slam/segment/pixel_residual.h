#pragma once

#include "slam/segment/block_pixels.h"

namespace slam {

/// The same as of the LabelPlane, for many pixels.
inline float ResidualSigmas(const DepthGrid& grid, std::size_t i, const PixelPlane& p) {
  const float predicted = p.a * grid.x[i] + p.b * grid.y[i] + p.c;
  return (grid.q[i] - predicted) * grid.g[i] / p.grazing;
}

}  // namespace slam
