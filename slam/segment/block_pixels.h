#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "slam/base/lanes.h"
#include "slam/segment/depth_grid.h"
#include "slam/segment/pixel_labels.h"
#include "slam/segment/pixel_set.h"

namespace slam {

/// A block of the depth image, size x size pixels or less where the image ends.
struct BlockPixels {
  const float *x, *y, *q, *g;  ///< where the first pixel's are (DepthGrid)
  int stride;                  ///< from row to row of q, g and label images
  int x_stride, y_stride;      ///< from row to row of x and y
  int width, height;
  int size;  ///< row length of what is computed of the block
};

/// Whether a block is 8 x 8 pixels, the usual, and none of it beyond the image's end.
inline bool IsWhole8(const BlockPixels& block) {
  return block.size == 8 && block.width == 8 && block.height == 8;
}

/// The block of size x size pixels that begins at (u, v).
inline BlockPixels BlockAt(const DepthGrid& grid, int u, int v, int size) {
  const auto i = static_cast<std::ptrdiff_t>(v) * grid.width + u;
  const bool one_x = !grid.column_x.empty();
  const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(v) * DepthGrid::kRowCopies;
  return {one_x ? grid.column_x.data() + u : grid.x.data() + i,
          one_x ? grid.row_y.data() + (row + DepthGrid::kCopiesBefore) : grid.y.data() + i,
          grid.q.data() + i,
          grid.g.data() + i,
          grid.width,
          one_x ? 0 : grid.width,
          one_x ? DepthGrid::kRowCopies : grid.width,
          std::min(size, grid.width - u),
          std::min(size, grid.height - v),
          size};
}

/// A plane in the numbers that pixels are in.
struct PixelPlane {
  explicit PixelPlane(const LabelPlane& p)
      : a(static_cast<float>(p.plane.a)),
        b(static_cast<float>(p.plane.b)),
        c(static_cast<float>(p.plane.c)),
        grazing(static_cast<float>(p.grazing)) {}
  float a, b, c, grazing;
};

/// Where the cost of a pixel looks: up to `reach` rows and columns beyond the pixel, in the
/// block and as far beyond it as the image goes.
struct CostWindow {
  int reach = 0;
  int left = 0, top = 0, right = 0, bottom = 0;  ///< beyond the block; at most reach
  float max_sigmas = 0.0f;                       ///< larger residuals count as this
};

/// Pixels that are measured.
void FindMeasured(const BlockPixels& block, PixelSet measured);

/// Measured pixels within two distances of a plane, in sigmas (ResidualSigmas).
/// @returns how many are within the first
int FindNear(const BlockPixels& block, const PixelPlane& plane, ConstPixelSet measured,
             float near_sigmas, float wide_sigmas, PixelSet near, PixelSet wide);

/// Sum of the residuals of the pixels of a set, in sigmas.
double SumResiduals(const BlockPixels& block, const PixelPlane& plane, ConstPixelSet set);

/// An array of a block has size x size entries, row by row, and goes on to so many, whole
/// lanes.
constexpr std::size_t EntriesOfBlock(int size) {
  return (static_cast<std::size_t>(size * size) + kLanes - 1) / kLanes * kLanes;
}

/// Lowers each entry to the distance of its pixel from a plane, in sigmas.
void LowerToDistance(const BlockPixels& block, const PixelPlane& plane, float* nearest);

/// Sum over the pixels of a set of the squared entry less the squared distance from a plane.
double SumGains(const BlockPixels& block, const PixelPlane& plane, ConstPixelSet set,
                const float* nearest);

/// What it costs to give each pixel of a set to a plane: the sum of the squared residuals of
/// the pixels around it, each cut off at max_sigmas^2, in sigmas^2; infinity for the other
/// pixels.
void FindCosts(const BlockPixels& block, const PixelPlane& plane, const CostWindow& window,
               ConstPixelSet near, float* costs);

}  // namespace slam
