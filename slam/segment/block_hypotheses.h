#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "slam/segment/pixel_set.h"

namespace slam {

inline constexpr int kNoHypothesis = -1;

/// A plane that a block's pixels may belong to, because it has reached the block. Neither what
/// is near it nor its costs depend on the other planes there, so they are computed once.
struct Hypothesis {
  int label = 0;
  int plane = 0;             ///< place of its plane (PlanesOnBlocks::pixel_planes)
  int next = kNoHypothesis;  ///< the next one of the block, by label
  int near = 0;              ///< pixels within max_pixel_sigmas
  int pixels = 0;            ///< pixels that it has
  int costs = -1;            ///< place of its costs; -1 = not computed yet
  bool measured = false;     ///< its sets are known
  bool spread = false;       ///< it has spread to the neighbours
};

/// The competing hypotheses of every block of an image, each with sets of the block's pixels.
class BlockHypotheses {
 public:
  enum Set {
    kNear,   ///< pixels within max_pixel_sigmas of the plane
    kWide,   ///< pixels within a sigma more
    kOwned,  ///< pixels that the plane has
    kSetCount
  };

  /// Forgets everything and begins with so many blocks of block_px x block_px pixels.
  void Begin(std::size_t blocks, int block_px);
  /// Forgets all hypotheses.
  void Clear();

  /// Adds one of a label that the block has none of yet.
  void Add(int block, int label, int plane);
  /// Takes out that of a label, which must be there.
  void Remove(int block, int label);
  /// That of a label, which must be there.
  int Find(int block, int label) const;

  /// The first hypothesis of a block; kNoHypothesis if it has none.
  int First(int block) const { return first_[static_cast<std::size_t>(block)]; }
  Hypothesis& At(int k) { return list_[static_cast<std::size_t>(k)]; }
  const Hypothesis& At(int k) const { return list_[static_cast<std::size_t>(k)]; }

  /// A view into the table; it moves when a hypothesis is added.
  PixelSet SetOf(int k, Set set) { return sets_.data() + PlaceOf(k, set); }
  ConstPixelSet SetOf(int k, Set set) const { return sets_.data() + PlaceOf(k, set); }
  std::size_t set_words() const { return set_words_; }
  std::size_t size() const { return list_.size(); }

  /// The pixels of a block that more than one hypothesis has in that set.
  void FindShared(int block, Set set, PixelSet shared) const;

 private:
  std::size_t PlaceOf(int k, Set set) const {
    return (static_cast<std::size_t>(k) * kSetCount + set) * set_words_;
  }

  std::size_t set_words_ = 0;
  std::vector<Hypothesis> list_;
  std::vector<std::uint64_t> sets_;  ///< kSetCount a hypothesis
  std::vector<int> first_;           ///< one a block
};

}  // namespace slam
