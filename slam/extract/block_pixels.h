#pragma once

#include <cstdint>

#include "slam/extract/depth_grid.h"
#include "slam/extract/pixel_labels.h"

namespace slam {

/// A block of the depth image, size x size pixels or less where the image ends.
struct BlockPixels {
  const float *x, *y, *q, *g;  ///< of its first pixel (DepthGrid)
  int stride;                  ///< from row to row of q, g and label images
  int x_stride, y_stride;      ///< and of x and y
  int width, height;
  int size;  ///< row length of what is computed of the block
};

/// The block of size x size pixels that begins at (u, v).
BlockPixels BlockAt(const DepthGrid& grid, int u, int v, int size);

/// A plane in the numbers that pixels are in.
struct PixelPlane {
  explicit PixelPlane(const LabelPlane& p)
      : a(static_cast<float>(p.plane.a)),
        b(static_cast<float>(p.plane.b)),
        c(static_cast<float>(p.plane.c)),
        grazing(static_cast<float>(p.grazing)) {}
  float a, b, c, grazing;
};

/// Where a bid looks: up to `reach` rows and columns beyond each pixel, in the block and as far
/// beyond it as the image goes.
struct BidWindow {
  int reach = 0;
  int left = 0, top = 0, right = 0, bottom = 0;  ///< at most reach
  float most_sigmas = 0.0f;
};

/// The largest `size` and `reach`.
inline constexpr int kMostBlockSide_px = 64, kMostBidReach_px = 16;

// Arrays of a block have size x size entries, row by row, and go on to `count`, a multiple
// of 8.

/// Residuals in sigmas (ResidualSigmas); infinity where nothing is measured and beyond the
/// image's end. @returns the least of their sizes.
float MeasureBlock(const BlockPixels& block, int count, const PixelPlane& plane,
                   float* residuals);

/// Sum of the squared residuals of the pixels around each pixel, each cut off at most_sigmas^2;
/// infinity where the pixel itself is most_sigmas or more away.
void BidForBlock(const BlockPixels& block, int count, const PixelPlane& plane,
                 const BidWindow& window, const float* residuals, float* bids);

/// Writes owners into the label image, or reads them from it.
void WriteOwners(const BlockPixels& block, const int* owners, std::int16_t* labels);
void ReadOwners(const BlockPixels& block, int count, const std::int16_t* labels, int* owners);

/// Whether the pixels of a block with a label in `from`, of which there is at least one, have
/// one and the same in `to`. @param from, to  of the block's first pixel; @param only  that
/// label
bool GoToOne(const BlockPixels& block, const std::int16_t* from, std::int16_t label,
             const std::int16_t* to, std::int16_t& only);

}  // namespace slam
