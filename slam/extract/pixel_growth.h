#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "slam/extract/block_sums.h"
#include "slam/extract/pixel_labels.h"

namespace slam {

struct GrowthConfig {
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
/// While they grow, a pixel belongs to the nearest plane, in sigmas, among those that have
/// reached its block, if it is nearer than max_pixel_sigmas; a plane that owns pixels of a
/// block reaches the block's 8 neighbours. Settle() then lets the pixels around decide where
/// planes compete. Rounds are synchronous: the outcome does not depend on the order of work.
class PixelGrowth {
 public:
  /// Forgets everything and begins with an image; memory is used again. `grid` and `block_sums`
  /// (of all measured pixels of each block) must live as long as this is used.
  void Start(const DepthGrid& grid, const BlockLayout& layout,
             const std::vector<PlaneSums>& block_sums, const GrowthConfig& config);

  /// Adds a plane. @returns its label.
  int AddPlane(const LabelPlane& plane);
  /// Lets a plane claim pixels of a block.
  void Reach(int block, int label);
  /// Spreads what was added since the last call.
  void Grow();
  /// Decides contested blocks whose planes changed since the last call.
  void Settle();
  /// Takes out the planes that gain less than min_gain, smallest first, and gives their pixels
  /// to the others.
  void DropUseless();
  /// Puts other planes in the place of the old ones: label k becomes into[k], of
  /// planes[into[k]].
  void Replace(const std::vector<LabelPlane>& planes, const std::vector<int>& into);
  /// Sums of the pixels of each label.
  void SumLabels(std::vector<PlaneSums>& sums) const {
    SumSegments(labels_, static_cast<int>(planes_.size()), sums);
  }
  /// The same of other labels, each of which holds all or nothing of what one label holds of a
  /// block.
  void SumSegments(const LabelImage& labels, int count, std::vector<PlaneSums>& sums) const;
  /// Marks the pixels that need no second look: those of blocks whose mean residual from their
  /// label's plane is below `model_sigmas` and `bias_sigmas` standard errors.
  void MarkSettled(double model_sigmas, double bias_sigmas, double correlated_px,
                   std::vector<std::uint8_t>& settled) const;

  const LabelImage& labels() const { return labels_; }
  const std::vector<LabelPlane>& planes() const { return planes_; }
  const BlockLayout& layout() const { return layout_; }

 private:
  static constexpr int kMostCandidates = 12;  ///< planes that may reach one block
  struct Block {
    std::array<std::int16_t, kMostCandidates> label;
    std::array<std::int16_t, kMostCandidates> near;  ///< pixels that may be the label's
    int count = 0;
    bool changed = false;
  };

  /// Floats of a block's row, in whole lanes.
  int Stride() const { return (layout_.block_px + kLanes - 1) / kLanes * kLanes; }
  int Claim(int block, int label);
  int Owned(int block, int label) const;
  void Reclaim(int block);
  void Vote(int block);
  void SumCosts(int block, const LabelPlane& plane, float* costs);
  bool Whole(int block) const;
  std::int32_t OnlyLabel(const LabelImage& labels, int block) const;
  void AddGains(int block);
  void TakeOut(int block, const std::vector<bool>& dropped);

  const DepthGrid* grid_ = nullptr;
  const std::vector<PlaneSums>* block_sums_ = nullptr;
  BlockLayout layout_;
  GrowthConfig config_;
  std::vector<LabelPlane> planes_;
  std::vector<Block> blocks_;
  std::vector<std::pair<int, int>> pending_, round_;  ///< (block, label)
  LabelImage labels_;
  std::vector<float> distance_;  ///< of each pixel from its label's plane, sigmas
  // Scratch.
  std::vector<float> costs_, rows_, line_;
  std::vector<double> gain_, without_;
  std::vector<int> pixels_;
};

}  // namespace slam
