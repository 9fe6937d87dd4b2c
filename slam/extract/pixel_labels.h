#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "slam/extract/depth_grid.h"
#include "slam/extract/label_runs.h"
#include "slam/extract/plane_sums.h"

namespace slam {

/// A plane that pixels may belong to.
struct LabelPlane {
  InverseDepthPlane plane;
  double grazing = 1.0;  ///< GrazingFactor of its pixels
};

inline constexpr std::int16_t kNoLabel = -1;
using LabelImage = std::vector<std::int16_t>;  ///< one entry a pixel, kNoLabel or an index

/// Sums of the pixels of each label.
std::vector<PlaneSums> SumLabels(const DepthGrid& grid, const LabelImage& labels, int count);

/// to[label] in place of each label.
void MapLabels(const LabelImage& labels, const std::vector<int>& to, LabelImage& out);

/// Residual of a pixel from a plane in sigmas; positive: the pixel is nearer than the plane.
inline float ResidualSigmas(const DepthGrid& grid, std::size_t i, const LabelPlane& p) {
  const float predicted = static_cast<float>(p.plane.a) * grid.x[i] +
                          static_cast<float>(p.plane.b) * grid.y[i] +
                          static_cast<float>(p.plane.c);
  return (grid.q[i] - predicted) * grid.g[i] / static_cast<float>(p.grazing);
}

/// A 4-connected set of pixels with one label.
struct LabelComponent {
  int label = 0;
  int pixels = 0;
  int first_pixel = 0;  ///< in row-major order
  /// Measured neighbours across its boundary that lie behind or in front of the label's plane.
  int behind = 0, in_front = 0;
};

/// Connected components of a label image, in order of their first pixel.
struct LabelComponents {
  std::vector<int> component;  ///< of each pixel; -1 where there is no label
  std::vector<LabelComponent> list;
  LabelRuns runs;  ///< of the label image
};
/// Without sides.
LabelComponents ConnectedComponents(const DepthGrid& grid, const LabelImage& labels);
LabelComponents ConnectedComponents(const DepthGrid& grid, const LabelImage& labels,
                                    const std::vector<LabelPlane>& planes);
/// Counts `behind` and `in_front` of every component.
void CountSides(const DepthGrid& grid, const LabelImage& labels,
                const std::vector<LabelPlane>& planes, LabelComponents& components);

}  // namespace slam
