#pragma once

#include <cstddef>
#include <optional>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/pixels/depth_grid.h"
#include "slam/segment/pixels/label_runs.h"

namespace slam {

/// A plane that pixels may belong to.
struct LabelPlane {
  InverseDepthPlane plane;
  double grazing = 1.0;  ///< GrazingFactor of its pixels
};

/// The plane through pixels; nothing where Fit finds none.
inline std::optional<LabelPlane> FitLabelPlane(const PlaneSums& sums, const DepthNoise& noise) {
  const std::optional<PlaneFit> fit = Fit(sums);
  if (!fit) return std::nullopt;
  return LabelPlane{fit->plane, GrazingFactor(sums, fit->plane, noise)};
}

/// Adds a measured pixel to the sums of a plane.
inline void AddPixel(const DepthGrid& grid, std::size_t i, PlaneSums& sums) {
  const double g = static_cast<double>(grid.g[i]);
  sums.Add(static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]),
           static_cast<double>(grid.q[i]), g * g);
}

}  // namespace slam
