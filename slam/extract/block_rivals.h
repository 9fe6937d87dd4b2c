#pragma once

#include "slam/extract/block_pixels.h"

namespace slam {

/// What a plane among others has of a block.
struct BlockRival {
  int label = 0;
  const float* residuals = nullptr;  ///< MeasureBlock
  const float* bids = nullptr;       ///< BidForBlock
  int pixels = 0;                    ///< ClaimBlock
  double gain = 0.0;                 ///< GainsOfBlock
};

// Arrays are those of block_pixels.h.

/// Gives each pixel to the only rival, if it is nearer than `most_sigmas`, or to the one with
/// the least bid (the first of equal ones). @param owners  label or kNoLabel
void ClaimBlock(BlockRival* rivals, int rival_count, int count, float most_sigmas, int* owners);

/// What each rival gains at its pixels over the next best one there, or over `unexplained`
/// sigmas: sum of differences of squared sigmas.
/// @param gains, next_labels  of each pixel; kNoLabel where there is no next best
void GainsOfBlock(BlockRival* rivals, int rival_count, int count, float unexplained,
                  const int* owners, float* gains, int* next_labels);

/// Sets the marks of the pixels of a block that `label` owns. @param marks  of its first pixel
void MarkOwned(const BlockPixels& block, int label, const int* owners, std::uint8_t* marks);

/// Sum of the residuals of the pixels that `label` owns.
double SumOwned(const float* residuals, int count, int label, const int* owners);

}  // namespace slam
