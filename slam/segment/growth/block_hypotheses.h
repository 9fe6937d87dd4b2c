#pragma once

#include <cstddef>
#include <vector>

#include "slam/base/index.h"
#include "slam/segment/pixels/pixel_set.h"

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
  /// Takes out that of a label, which must be there.
  void Remove(int block, int label);
  /// That of a label, which must be there.
  int Find(int block, int label) const;

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

}  // namespace slam
