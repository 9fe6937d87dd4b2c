#pragma once

#include <cstddef>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/pixels/depth_grid.h"
#include "slam/segment/pixels/pixel_labels.h"
#include "slam/segment/pixels/pixel_set.h"

namespace slam {

/// A block of 8 x 8 pixels of a depth image that may be read kVoteReach_px beyond each side:
/// where the image ends it goes on with pixels that are not measured (ImageBlocks).
struct BlockPixels {
  const float *x, *y, *q, *g;  ///< where the first pixel's are (DepthGrid)
  int stride, x_stride;        ///< from row to row; of x: 0 where columns have one
  int width, height;           ///< what of it is in the image
};

/// A plane in the numbers that pixels are in.
struct PixelPlane {
  explicit PixelPlane(const LabelPlane& p)
      : a(static_cast<float>(p.plane.a)),
        b(static_cast<float>(p.plane.b)),
        c(static_cast<float>(p.plane.c)),
        grazing(static_cast<float>(p.grazing)) {}
  float a, b, c, grazing;
};

/// Residual of a pixel from a plane in sigmas; positive: the pixel is nearer than the plane.
inline float ResidualSigmas(const DepthGrid& grid, std::size_t i, const PixelPlane& p) {
  const float predicted = p.a * grid.x[i] + p.b * grid.y[i] + p.c;
  return (grid.q[i] - predicted) * grid.g[i] / p.grazing;
}

/// Numbers of the pixels of a block, row by row.
inline constexpr int kBlockPixels = kBlock_px * kBlock_px;

/// Pixels that are measured.
PixelSet FindMeasured(const BlockPixels& block);

/// Measured pixels within two distances of a plane, in sigmas (ResidualSigmas).
struct NearPixels {
  PixelSet near = 0, wide = 0;
};
NearPixels FindNear(const BlockPixels& block, const PixelPlane& plane, PixelSet measured,
                    float near_sigmas, float wide_sigmas);

/// Sum of the residuals of the pixels of a set, in sigmas.
double SumResiduals(const BlockPixels& block, const PixelPlane& plane, PixelSet set);

/// Lowers each entry to the distance of its pixel from a plane, in sigmas.
void LowerToDistance(const BlockPixels& block, const PixelPlane& plane, float* nearest);

/// Sum over the pixels of a set of the squared entry less the squared distance from a plane.
double SumGains(const BlockPixels& block, const PixelPlane& plane, PixelSet set,
                const float* nearest);

/// What it costs to give each pixel of a set to a plane: the sum of the squared residuals of
/// the pixels up to kVoteReach_px rows and columns away, each cut off at max_sigmas^2, in
/// sigmas^2; infinity for the other pixels.
void FindCosts(const BlockPixels& block, const PixelPlane& plane, float max_sigmas,
               PixelSet near, float* costs);

/// Sums of the pixels of a set, all of them measured.
PlaneSums SumOfSet(const BlockPixels& block, PixelSet set);

/// Whether two neighbouring measured pixels of a set differ by more than `max_sigmas`.
bool HasJump(const BlockPixels& block, float max_sigmas, PixelSet within);

}  // namespace slam
