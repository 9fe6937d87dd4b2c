#pragma once

#include <vector>

#include "slam/base/index.h"
#include "slam/segment/growth/block_hypotheses.h"
#include "slam/segment/growth/growth_config.h"
#include "slam/segment/growth/reached_blocks.h"
#include "slam/segment/joining/local_planes.h"
#include "slam/segment/pixels/image_blocks.h"
#include "slam/segment/pixels/pixel_labels.h"

namespace slam {

/// Planes that grow over the blocks of an image: where each has come, and which compete there.
struct PlanesOnBlocks {
  const ImageBlocks* blocks = nullptr;   ///< the image
  std::vector<LabelPlane> planes;        ///< one a label
  std::vector<PixelPlane> pixel_planes;  ///< of all labels, in the numbers that pixels are in
  struct Planes {
    int first = 0;       ///< place in pixel_planes
    bool local = false;  ///< one for each tile (FitLocally)
  };
  std::vector<Planes> planes_of;  ///< one a label
  ReachedBlocks reached;
  BlockHypotheses hypotheses;

  /// The place of a label's plane in a block.
  int PlaneIndex(int block, int label) const {
    const Planes& own = planes_of[Index(label)];
    if (!own.local) return own.first;
    const int cols = blocks->cols;
    return own.first + block / cols / kTile_blocks * TileCount(cols) +
           block % cols / kTile_blocks;
  }
  const PixelPlane& PlaneOf(int hypothesis) const {
    return pixel_planes[Index(hypotheses.At(hypothesis).plane)];
  }
};

/// Within this distance of a plane a pixel is near it (Hypothesis::near).
inline float NearSigmas(const GrowthConfig& config) {
  return static_cast<float>(config.max_pixel_sigmas);
}
/// One sigma more (Hypothesis::wide): noise may have taken the pixel out of reach.
inline float WideSigmas(const GrowthConfig& config) {
  return static_cast<float>(config.max_pixel_sigmas + 1.0);
}

}  // namespace slam
