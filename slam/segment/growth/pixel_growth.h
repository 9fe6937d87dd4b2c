#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "slam/base/index.h"
#include "slam/geometry/plane_sums.h"
#include "slam/segment/growth/block_assignment.h"
#include "slam/segment/growth/growth_config.h"
#include "slam/segment/growth/planes_on_blocks.h"
#include "slam/segment/pixels/pixel_labels.h"

namespace slam {

/// Region growing: planes spread over the pixels of an image, from block to block.
///
/// A plane begins at seeds. A pixel goes to the nearest plane, in sigmas, among those that have
/// reached its block, if it is nearer than max_pixel_sigmas; where several are near, to the one
/// that fits the pixels around it best. A plane that owns pixels of a block reaches the block's
/// 8 neighbours, all planes a block further at a time. The memory of one image serves the next.
class PixelGrowth {
 public:
  /// Forgets everything and begins with an image, which must outlive what is done with it.
  void Begin(const ImageBlocks& blocks, const GrowthConfig& config);

  /// Adds a plane. @returns its label.
  /// @param local  its planes by tiles (FitLocally); empty: the plane itself everywhere
  int AddPlane(const LabelPlane& plane, const std::vector<LabelPlane>& local);
  /// Lets a plane begin in a block.
  void Seed(int block, int label);
  /// Spreads the planes added or changed since the last call.
  void Grow();
  /// Takes out the planes that gain less than min_gain, smallest first, and gives their pixels
  /// to the others.
  void DropUseless();
  /// Goes on with other planes for the labels: `planes` in place of the old ones and the pixels
  /// of label k counted as those of into[k]; everything is grown anew from there.
  /// @param local  of each label its planes by tiles, as for AddPlane
  void Replace(const std::vector<LabelPlane>& planes, const std::vector<int>& into,
               const std::vector<std::vector<LabelPlane>>& local);
  bool IsLocal(int label) const { return on_.planes_of[Index(label)].local; }

  /// The measured pixels of each block but for those that their planes explain: in the block
  /// their mean residual from the plane is less than `bias` + `standard_errors` / sqrt(the
  /// plane's pixels there), sigmas.
  std::vector<PixelSet> FindUnexplained(double bias, double standard_errors) const;

  /// What labels have of each block.
  /// @param whole  sums of the measured pixels of each block
  void SumParts(const std::vector<PlaneSums>& whole, PartsOnBlocks& out) const;

  /// The label of every pixel. @param width, height  the image's
  void DrawLabels(int width, int height, LabelImage& labels);

  const std::vector<LabelPlane>& planes() const { return on_.planes; }

 private:
  void Activate(int block);
  bool Measure(int block, int hypothesis);
  void FindCostsOf(int block, int hypothesis);
  float* CostsOf(int hypothesis) {
    return costs_.data() +
           static_cast<std::size_t>(on_.hypotheses.At(hypothesis).costs) * kBlockPixels;
  }
  void Assign(int block);
  bool LabelBlock(int block);
  void SpreadFrom(int block);

  cv::Point PlaceOf(int block) const {
    return {block % on_.blocks->cols, block / on_.blocks->cols};
  }

  GrowthConfig config_;
  PlanesOnBlocks on_;
  std::vector<int> active_, next_active_;  ///< blocks that planes have reached
  std::vector<std::uint8_t> is_active_;
  std::vector<std::uint8_t> is_reached_;  ///< label by label, whether it has reached each block
  /// Blocks whose pixels are not assigned to their hypotheses yet.
  std::vector<std::uint8_t> is_stale_;
  std::vector<float> costs_;  ///< FindCosts of the hypotheses that compete
  std::size_t cost_count_ = 0;
  // Scratch of one block.
  std::vector<CompetingPlane> competing_;
  std::vector<BlockOwner> owners_;
};

}  // namespace slam
