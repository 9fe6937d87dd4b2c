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

/// What a plane among others has of a block.
struct BlockRival {
  int label = 0;
  const float* residuals = nullptr;  ///< MeasureBlock
  const float* bids = nullptr;       ///< BidForBlock
  int pixels = 0;                    ///< ClaimBlock
  double gain = 0.0;                 ///< GainsOfBlock
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

/// Gives each pixel to the only rival, if it is nearer than `most_sigmas`, or to the one with
/// the least bid (the first of equal ones). @param owners  label or kNoLabel
void ClaimBlock(BlockRival* rivals, int rival_count, int count, float most_sigmas, int* owners);

/// What each rival gains at its pixels over the next best one there, or over `unexplained`
/// sigmas: sum of differences of squared sigmas.
/// @param gains, next_labels  of each pixel; kNoLabel where there is no next best
void GainsOfBlock(BlockRival* rivals, int rival_count, int count, float unexplained,
                  const int* owners, float* gains, int* next_labels);

/// Sum of the residuals of the pixels that `label` owns.
double SumOwned(const float* residuals, int count, int label, const int* owners);

/// Writes owners into the label image, or reads them from it.
void WriteOwners(const BlockPixels& block, const int* owners, std::int16_t* labels);
void ReadOwners(const BlockPixels& block, int count, const std::int16_t* labels, int* owners);

/// How many pixels of a block have the one label that there is in it, or 0 if there are others.
/// @param labels  of the block's first pixel
int CountOnly(const BlockPixels& block, const std::int16_t* labels, std::int16_t& label);

}  // namespace slam
