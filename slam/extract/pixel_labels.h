#pragma once

#include <cstdint>
#include <vector>

#include "slam/extract/depth_grid.h"
#include "slam/extract/lanes.h"
#include "slam/extract/plane_sums.h"

namespace slam {

/// A plane that pixels may belong to.
struct LabelPlane {
  InverseDepthPlane plane;
  double grazing = 1.0;  ///< GrazingFactor of its pixels
};

inline constexpr std::int32_t kNoLabel = -1;
using LabelImage = std::vector<std::int32_t>;  ///< one entry a pixel, kNoLabel or an index

/// Residuals of pixels from one plane, in sigmas; positive: the pixel is nearer than the plane.
/// An unmeasured pixel has residual 0.
struct PlaneResidual {
  float a, b, c, scale;

  explicit PlaneResidual(const LabelPlane& p)
      : a(static_cast<float>(p.plane.a)),
        b(static_cast<float>(p.plane.b)),
        c(static_cast<float>(p.plane.c)),
        scale(static_cast<float>(1.0 / p.grazing)) {}
  float operator()(float x, float y, float q, float g) const {
    return (q - (a * x + b * y + c)) * (g * scale);
  }
  Floats operator()(const Floats& x, const Floats& y, const Floats& q, const Floats& g) const {
    return (q - (All(a) * x + All(b) * y + All(c))) * (g * All(scale));
  }
  float operator()(const DepthGrid& grid, std::size_t i) const {
    return (*this)(grid.x[i], grid.y[i], grid.q[i], grid.g[i]);
  }
};

inline float ResidualSigmas(const DepthGrid& grid, std::size_t i, const LabelPlane& p) {
  return PlaneResidual(p)(grid, i);
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
  std::vector<int> component;  ///< of each pixel; only where there is a label
  std::vector<LabelComponent> list;
  // Scratch.
  std::vector<int> parent, compact;
};

/// @param planes  of the labels
void FindComponents(const DepthGrid& grid, const LabelImage& labels,
                    const std::vector<LabelPlane>& planes, LabelComponents& out);

}  // namespace slam
