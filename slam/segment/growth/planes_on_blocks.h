#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "slam/base/index.h"
#include "slam/segment/growth/growth_config.h"
#include "slam/segment/joining/local_planes.h"
#include "slam/segment/pixels/image_blocks.h"
#include "slam/segment/pixels/pixel_labels.h"

namespace slam {

inline constexpr int kNoHypothesis = -1;

/// A plane that a block's pixels may belong to, because it has reached the block. Neither what
/// is near it nor its costs depend on the other planes there, so they are computed once.
struct Hypothesis {
  int label = 0;
  int plane = 0;             ///< place of its plane (PlanesOnBlocks::pixel_planes)
  int next = kNoHypothesis;  ///< the next one of the block, by label
  int costs = -1;            ///< place of its costs; -1 = not computed yet
  bool measured = false;     ///< `near` and `wide` are known
  bool spread = false;       ///< it has spread to the neighbours
  PixelSet near = 0;         ///< pixels within max_pixel_sigmas of the plane
  PixelSet wide = 0;         ///< pixels within a sigma more
  PixelSet owned = 0;        ///< pixels that the plane has
};

/// The competing hypotheses of every block of an image.
class BlockHypotheses {
 public:
  /// Forgets everything and begins with so many blocks.
  void Begin(std::size_t blocks) { list_.clear(), first_.assign(blocks, kNoHypothesis); }

  /// Adds one of a label that the block has none of yet.
  void Add(int block, int label, int plane);
  /// Takes out those of the labels with a 1. @returns whether there was one
  bool Remove(int block, const std::vector<std::uint8_t>& labels);

  /// The first hypothesis of a block; kNoHypothesis if it has none.
  int First(int block) const { return first_[Index(block)]; }
  Hypothesis& At(int k) { return list_[Index(k)]; }
  const Hypothesis& At(int k) const { return list_[Index(k)]; }
  std::size_t size() const { return list_.size(); }

  /// The pixels of a block that more than one hypothesis has in that set.
  PixelSet FindShared(int block, PixelSet Hypothesis::*set) const;

 private:
  std::vector<Hypothesis> list_;
  std::vector<int> first_;  ///< one a block
};

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
