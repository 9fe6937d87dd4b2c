#pragma once

#include <cstddef>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/pixels/depth_grid.h"
#include "slam/segment/pixels/label_runs.h"

namespace slam {

/// A plane that pixels may belong to.
struct LabelPlane {
  InverseDepthPlane plane;
  double grazing = 1.0;  ///< GrazingFactor of its pixels
};

/// Adds a measured pixel to the sums of a plane.
inline void AddPixel(const DepthGrid& grid, std::size_t i, PlaneSums& sums) {
  const double g = static_cast<double>(grid.g[i]);
  sums.Add(static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]),
           static_cast<double>(grid.q[i]), g * g);
}

/// Residual of a pixel from a plane in sigmas; positive: the pixel is nearer than the plane.
inline float ResidualSigmas(const DepthGrid& grid, std::size_t i, const LabelPlane& p) {
  const float predicted = static_cast<float>(p.plane.a) * grid.x[i] +
                          static_cast<float>(p.plane.b) * grid.y[i] +
                          static_cast<float>(p.plane.c);
  return (grid.q[i] - predicted) * grid.g[i] / static_cast<float>(p.grazing);
}

}  // namespace slam
