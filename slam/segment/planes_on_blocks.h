#pragma once

#include <vector>

#include "slam/segment/block_hypotheses.h"
#include "slam/segment/block_pixels.h"
#include "slam/segment/growth_config.h"
#include "slam/segment/pixel_labels.h"
#include "slam/segment/reached_blocks.h"

namespace slam {

/// Planes that grow over the blocks of an image: where each has come, and which compete there.
struct PlanesOnBlocks {
  int cols = 0, rows = 0;                ///< the image's, in blocks
  std::vector<BlockPixels> blocks;       ///< row by row
  std::vector<LabelPlane> planes;        ///< one a label
  std::vector<PixelPlane> pixel_planes;  ///< the same in the numbers that pixels are in
  ReachedBlocks reached;
  BlockHypotheses hypotheses;

  int block_count() const { return cols * rows; }
  const BlockPixels& PixelsOf(int block) const {
    return blocks[static_cast<std::size_t>(block)];
  }
  const PixelPlane& PlaneOf(int hypothesis) const {
    return pixel_planes[static_cast<std::size_t>(hypotheses.At(hypothesis).label)];
  }
};

/// Within this distance of a plane a pixel is near it (BlockHypotheses::kNear).
inline float NearSigmas(const GrowthConfig& config) {
  return static_cast<float>(config.max_pixel_sigmas);
}
/// One sigma more (BlockHypotheses::kWide): noise may have taken the pixel out of reach.
inline float WideSigmas(const GrowthConfig& config) {
  return static_cast<float>(config.max_pixel_sigmas + 1.0);
}

}  // namespace slam
