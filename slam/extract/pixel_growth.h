#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "slam/extract/depth_grid.h"
#include "slam/extract/pixel_labels.h"

namespace slam {

struct GrowthConfig {
  int block_px = 8;               ///< regions spread from block to block; domain [2, 64]
  double max_pixel_sigmas = 3.0;  ///< distance of a plane's pixel from it; domain (0, inf)
  /// A pixel between two planes goes to the one that fits the pixels within this many rows and
  /// columns best: the noise of single pixels must not decide. Domain [0, 16].
  int vote_reach_px = 2;
  /// A plane must explain its pixels better than the next best plane there does, by this much
  /// on average (difference of squared sigmas); otherwise it only steals from its neighbours,
  /// as the plane of a block across a step does. Domain [0, inf).
  double min_gain = 3.0;
};

/// Planes growing over the pixels of an image, from block to block.
///
/// A pixel goes to the nearest plane, in sigmas, among those that have reached its block, if it
/// is nearer than max_pixel_sigmas. A plane that owns pixels of a block reaches the block's 8
/// neighbours. The outcome does not depend on the order of work.
class PixelGrowth {
 public:
  PixelGrowth(const DepthGrid& grid, const GrowthConfig& config);

  /// Adds a plane that may claim pixels at once in `blocks`. @returns its label.
  int AddPlane(const LabelPlane& plane, const std::vector<int>& blocks);
  int BlockAt(int u, int v) const {
    return v / config_.block_px * cols_ + u / config_.block_px;
  }
  /// Spreads the planes added or changed since the last call.
  void Grow();
  /// Takes out the planes that gain less than min_gain, smallest first, and gives their pixels
  /// to the others.
  void DropUseless();
  /// Goes on with other planes for the labels: `planes` in place of the old ones and the pixels
  /// of label k counted as those of into[k]; everything is grown anew from there.
  void Replace(std::vector<LabelPlane> planes, const std::vector<int>& into);

  const LabelImage& labels() const { return labels_; }
  const std::vector<LabelPlane>& planes() const { return planes_; }

 private:
  /// What is known of a plane in a block that it has reached. Neither distances nor bids
  /// depend on the other planes there, so they are computed once.
  struct Claim {
    int label = 0;
    std::size_t slot = 0;   ///< of its block of pixels in distances_ and bids_
    bool measured = false;  ///< distances_ are
    bool near = false;      ///< some pixel of the block may belong to the plane
    bool bidding = false;   ///< bids_ are
  };

  /// What each label gains over the next best plane at its pixels, and how that would change if
  /// that plane were not there.
  struct Gains {
    std::vector<double> gain;  ///< sum over the label's pixels
    std::vector<int> pixels;
    std::vector<double> without;  ///< [label][next best], increase
  };

  bool Reach(int block, int label);
  cv::Rect BlockArea(int block) const;
  void Measure(const cv::Rect& area, Claim& claim);
  void Bid(const cv::Rect& area, Claim& claim);
  void LabelBlock(int block);
  void ClaimUncontested(const Claim& only);
  void ClaimContested(const cv::Rect& area);
  void AddGains(int block, Gains& gains);
  void Drop(const std::vector<bool>& dropped);

  const DepthGrid& grid_;
  GrowthConfig config_;
  int cols_, rows_;
  std::size_t slot_size_;  ///< pixels of a block
  std::vector<LabelPlane> planes_;
  std::vector<std::vector<Claim>> reached_;  ///< of each block, by label
  std::vector<int> active_;                  ///< blocks whose labels changed
  LabelImage labels_;
  std::vector<float> distances_;  ///< sigmas; infinity where nothing is measured
  /// Sum of the squared distances of the pixels around a pixel, each cut off where it no longer
  /// belongs; infinity where the pixel itself is too far.
  std::vector<float> bids_;
  // Scratch of one block.
  std::vector<Claim*> rivals_;
  std::vector<int> owned_;  ///< pixels of each claim
  std::vector<float> squares_, row_sums_, least_, own_, next_;
  std::vector<std::int16_t> winner_, next_label_;
};

}  // namespace slam
